// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/mission/condition.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <optional>
#include <utility>

#include "bathyal/base/error.hpp"

namespace bathyal {
namespace {

constexpr std::size_t kLongest = 1000;
constexpr int kMostBrackets = 50;

struct Unit {
  std::string_view name;
  double factor;
  std::string_view quantity;  ///< the unit that it is a multiple of
};
constexpr std::array<Unit, 13> kUnits{{{"m", 1.0, "m"},
                                       {"cm", 0.01, "m"},
                                       {"km", 1000.0, "m"},
                                       {"s", 1.0, "s"},
                                       {"min", 60.0, "s"},
                                       {"h", 3600.0, "s"},
                                       {"%", 0.01, "1"},
                                       {"V", 1.0, "V"},
                                       {"deg", M_PI / 180.0, "rad"},
                                       {"rad", 1.0, "rad"},
                                       {"m/s", 1.0, "m/s"},
                                       {"A", 1.0, "A"},
                                       {"kg", 1.0, "kg"}}};

bool begins_word(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; }
bool digit(char c) { return c >= '0' && c <= '9'; }
bool in_word(char c) { return begins_word(c) || digit(c) || c == '.'; }

}  // namespace

class Condition::Parser {
 public:
  Parser(std::string_view text, std::span<const std::string> signals,
         std::span<const std::string> units, std::vector<Step>& steps)
      : text_(text), signals_(signals), units_(units), steps_(steps) {}

  void parse() {
    any_of();
    skip();
    if (at_ != text_.size()) fail("the end, and or or");
  }

 private:
  [[noreturn]] void fail(const std::string& expected) const {
    std::string got = "the end";
    if (at_ < text_.size()) got.assign("'").append(text_.substr(at_, 20)).append("'");
    got.append(" at column ").append(std::to_string(at_ + 1));
    got.append(" of '").append(text_.substr(0, 80)).append("'");
    throw_argument("condition", expected, got);
  }

  void skip() {
    while (at_ < text_.size() && (text_[at_] == ' ' || text_[at_] == '\t')) ++at_;
  }

  std::string_view word() const {
    std::size_t end = at_;
    if (end < text_.size() && begins_word(text_[end])) {
      while (end < text_.size() && in_word(text_[end])) ++end;
    }
    return text_.substr(at_, end - at_);
  }

  bool take_word(std::string_view expected) {
    skip();
    if (word() != expected) return false;
    at_ += expected.size();
    return true;
  }

  bool take(std::string_view sign) {
    skip();
    if (text_.substr(at_, sign.size()) != sign) return false;
    at_ += sign.size();
    return true;
  }

  void any_of() {
    if (++depth_ > kMostBrackets) fail("at most 50 levels of brackets");
    all_of();
    while (take_word("or")) {
      all_of();
      steps_.push_back({Code::kOr});
    }
    --depth_;
  }

  void all_of() {
    negated();
    while (take_word("and")) {
      negated();
      steps_.push_back({Code::kAnd});
    }
  }

  void negated() {
    bool odd = false;
    while (take_word("not")) odd = !odd;
    single();
    if (odd) steps_.push_back({Code::kNot});
  }

  void single() {
    if (take("(")) {
      any_of();
      if (!take(")")) fail("a closing bracket");
      return;
    }
    const std::string_view left = value();
    constexpr std::array<std::pair<std::string_view, Code>, 6> kSigns{{{"<=", Code::kLessEqual},
                                                                       {">=", Code::kGreaterEqual},
                                                                       {"==", Code::kEqual},
                                                                       {"!=", Code::kNotEqual},
                                                                       {"<", Code::kLess},
                                                                       {">", Code::kGreater}}};
    for (const auto& [sign, code] : kSigns) {
      if (!take(sign)) continue;
      skip();
      const std::size_t from = at_;
      const std::string_view right = value();
      if (!left.empty() && !right.empty() && left != right) {
        at_ = from;
        fail(std::string("a quantity in ").append(left));
      }
      steps_.push_back({code});
      return;
    }
    if (steps_.back().code != Code::kSignal) fail("a comparison");
    steps_.push_back({Code::kNumber, 0.0});  // a signal alone: not 0
    steps_.push_back({Code::kNotEqual});
  }

  /// \return the unit of its quantity; "" where that is not known
  std::string_view value() {
    skip();
    const std::string_view name = word();
    if (name.empty()) return number();
    const auto found = std::find(signals_.begin(), signals_.end(), name);
    if (found == signals_.end()) fail("a signal that is known");
    at_ += name.size();
    const auto row = found - signals_.begin();
    steps_.push_back({Code::kSignal, 0.0, static_cast<int>(row)});
    return units_.empty() ? std::string_view() : units_[static_cast<std::size_t>(row)];
  }

  std::string_view number() {
    double parsed = 0.0;
    const char* const begin = text_.data() + at_;
    const auto [end, error] = std::from_chars(begin, text_.data() + text_.size(), parsed);
    if (error != std::errc{} || !std::isfinite(parsed)) fail("a signal or a number");
    at_ += static_cast<std::size_t>(end - begin);
    const Unit of = unit();
    steps_.push_back({Code::kNumber, parsed * of.factor});
    return of.quantity;
  }

  Unit unit() {
    skip();
    Unit longest{"", 1.0, ""};
    for (const Unit& unit : kUnits) {
      const std::size_t end = at_ + unit.name.size();
      const bool whole = unit.name == "%" || end >= text_.size() || !in_word(text_[end]);
      if (text_.substr(at_, unit.name.size()) != unit.name || !whole) continue;
      if (unit.name.size() > longest.name.size()) longest = unit;
    }
    at_ += longest.name.size();
    return longest;
  }

  std::string_view text_;
  std::span<const std::string> signals_, units_;
  std::vector<Step>& steps_;
  std::size_t at_ = 0;
  int depth_ = 0;
};

Condition::Condition(std::string_view text, std::span<const std::string> signals,
                     std::span<const std::string> units)
    : text_(text), signal_count_(signals.size()) {
  if (text.size() > kLongest) {
    throw_argument("condition", "at most 1000 characters", std::to_string(text.size()));
  }
  if (!units.empty() && units.size() != signals.size()) {
    throw_argument("units", "one a signal", std::to_string(units.size()));
  }
  Parser(text_, signals, units, steps_).parse();
}

bool Condition::holds(std::span<const double> values) const {
  std::array<double, 2 * kMostBrackets + 8> stack{};
  std::size_t top = 0;
  for (const Step& step : steps_) {
    if (step.code == Code::kNumber) {
      stack[top++] = step.number;
      continue;
    }
    if (step.code == Code::kSignal) {
      stack[top++] = values[static_cast<std::size_t>(step.signal)];
      continue;
    }
    const double b = stack[--top];
    if (step.code == Code::kNot) {
      stack[top++] = b == 0.0 ? 1.0 : 0.0;
      continue;
    }
    const double a = stack[--top];
    bool result = false;
    switch (step.code) {
      case Code::kLess:
        result = a < b;
        break;
      case Code::kLessEqual:
        result = a <= b;
        break;
      case Code::kGreater:
        result = a > b;
        break;
      case Code::kGreaterEqual:
        result = a >= b;
        break;
      case Code::kEqual:
        result = a == b;
        break;
      case Code::kNotEqual:
        result = a < b || a > b;
        break;
      case Code::kAnd:
        result = a != 0.0 && b != 0.0;
        break;
      default:
        result = a != 0.0 || b != 0.0;
    }
    stack[top++] = result ? 1.0 : 0.0;
  }
  return stack[0] != 0.0;
}

}  // namespace bathyal
