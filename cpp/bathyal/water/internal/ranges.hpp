// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "bathyal/base/error.hpp"

namespace bathyal {

/// Collects what lies outside the range of a formula, by name.
class OutsideRanges {
 public:
  void add(const char* name, double value, double low, double high, const char* unit = "") {
    if (value >= low && value <= high) return;
    text_ += (text_.empty() ? "" : ", ") + std::string(name) + " " + to_text(value) + unit + " (" +
             to_text(low) + " to " + to_text(high) + ")";
  }
  const std::string& text() const { return text_; }

 private:
  std::string text_;
};

}  // namespace bathyal
