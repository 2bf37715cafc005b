// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace bathyal {

/// A condition in words, as "depth > 40 m or battery < 20 %": comparisons of signals with numbers
/// or with one another, joined by and, or, not and brackets. It names signals, and calls nothing.
class Condition {
 public:
  /// \param signals names that it may use, each its row
  /// \param units of the signals: m, s, rad, m/s, V, A, kg, or 1 for a share or a count; with them
  ///        a signal is compared with its own quantity, or with a number without a unit. None: not
  ///        checked.
  /// \throw std::invalid_argument with the column (from 1) of what is not understood, for a signal
  ///        that is not known or compared with another quantity, and for more than 1 000
  ///        characters.
  Condition(std::string_view text, std::span<const std::string> signals,
            std::span<const std::string> units = {});

  /// \param values of the signals; one that is NaN makes a comparison false
  bool holds(std::span<const double> values) const;

  const std::string& text() const { return text_; }
  std::size_t signal_count() const { return signal_count_; }

 private:
  enum class Code {
    kNumber,
    kSignal,
    kLess,
    kLessEqual,
    kGreater,
    kGreaterEqual,
    kEqual,
    kNotEqual,
    kAnd,
    kOr,
    kNot
  };
  struct Step {
    Code code;
    double number = 0.0;
    int signal = 0;
  };
  class Parser;

  std::string text_;
  std::size_t signal_count_ = 0;
  std::vector<Step> steps_;  ///< in the order of a stack machine
};

}  // namespace bathyal
