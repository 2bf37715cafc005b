// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "bathyal/base/error.hpp"
#include "bathyal/effects/internal/library.hpp"

// Steps: bases and tools that moved between sessions, a tool that slipped.

namespace bathyal::effects {
namespace {

constexpr int kFewestRows =
    3;  ///< of a session or a side of a moment: fewer do not determine a frame
constexpr Index kMostMoments = 400;

/// Labels of the sessions that have enough rows, in rising order.
std::vector<double> sessions_of(const EffectData& data) {
  std::vector<double> out;
  if (!data.has("session")) return out;
  std::map<double, int> count;
  for (const double label : data.covariate("session").reshaped()) ++count[label];
  for (const auto& [label, rows] : count) {
    if (rows >= kFewestRows) out.push_back(label);
  }
  return out;
}

std::string numbered(std::string name, std::size_t number) {
  return name.append("_").append(std::to_string(number));
}

/// Three shifts, and turns where wanted; "shift_x_2" is that of the second session.
std::vector<EffectParameter> shift_and_turn(bool turns, std::size_t session = 0) {
  std::vector<EffectParameter> out;
  for (const std::string& axis : frame_axes("shift", "turn", turns)) {
    out.push_back({session == 0 ? axis : numbered(axis, session), out.size() < 3 ? "m" : "rad",
                   kTypicalError});
  }
  return out;
}

/// A frame that is elsewhere in some sessions. Settings give either "from", the label of the
/// session from which on all sessions moved ("turns" is 0 where it moved without a turn), or a
/// label for each session that moved by itself: "session_2" of the second one.
class FrameBySession : public Effect {
 public:
  std::vector<EffectVariant> variants(const EffectData& data) const override {
    const std::vector<double> sessions = sessions_of(data);
    std::vector<EffectVariant> out;
    const auto add_from_each = [&](bool turned) {
      for (std::size_t s = 1; s < sessions.size(); ++s) {
        out.push_back({name(), -1, {{"from", sessions[s]}}, shift_and_turn(turned, s + 1), name()});
        if (turns(data) && !turned) out.back().settings["turns"] = 0.0;
      }
    };
    add_from_each(turns(data));
    if (sessions.size() > 2) {
      EffectVariant each{name(), -1, {}, {}, name()};
      for (std::size_t s = 1; s < sessions.size(); ++s) {
        each.settings[numbered("session", s + 1)] = sessions[s];
        for (EffectParameter& p : shift_and_turn(turns(data), s + 1)) {
          each.parameters.push_back(std::move(p));
        }
      }
      out.push_back(std::move(each));
    }
    // One that moved and did not turn: where poses hardly distinguish it from a tool, turns that
    // are not there would be evidence against it.
    if (turns(data)) add_from_each(false);
    return out;
  }

  Perturbations perturbations(const EffectVariant& variant, const EffectData& data) const override {
    const Eigen::ArrayXd session = data.covariate("session").col(0).array();
    const auto from = variant.settings.find("from");
    const std::size_t frames = from != variant.settings.end() ? 1 : variant.settings.size();
    const int axes = static_cast<int>(variant.parameters.size() / std::max<std::size_t>(1, frames));
    Perturbations out;
    const auto add = [&](const Eigen::ArrayXd& moved) {
      for (int axis = 0; axis < axes; ++axis) {
        out.push_back({move_frame(frame(data), axis, moved)});
      }
    };
    if (from != variant.settings.end()) {
      add((session >= from->second).cast<double>());
      return out;
    }
    for (std::size_t s = 2; s <= frames + 1; ++s) {
      const double label = setting_of(variant, numbered("session", s));
      add((session == label).cast<double>());
    }
    return out;
  }

 private:
  virtual std::string name() const = 0;
  virtual int frame(const EffectData& data) const = 0;
  virtual bool turns(const EffectData& data) const = 0;
};

/// " from session 3 on"
std::string sessions_of(const EffectVariant& variant) {
  const auto from = variant.settings.find("from");
  return from == variant.settings.end() ? " in each session by itself"
                                        : " from session " + to_text(from->second) + " on";
}

class BaseShift final : public FrameBySession {
 public:
  EffectInfo info() const override {
    return {
        .name = "base_shift",
        .description =
            "the base, or the tracker's frame, was elsewhere in some sessions than in the first",
        .formula =
            "base' = base · shift, turn (one for each later session, or one from a session on)",
        .source =
            "Mooring, Roth, Driels: Fundamentals of manipulator calibration, 1991, on base frames",
        .needs = {"session"},
        .ranges = {{.parameter = "shift_x_2", .unit = "m", .low = 1e-6, .high = 0.1},
                   {.parameter = "turn_x_2", .unit = "rad", .low = 1e-6, .high = 0.1}}};
  }
  std::string describe(const EffectVariant& variant, const Arm&) const override {
    return "the base, or the tracker, moved" + sessions_of(variant);
  }

 private:
  std::string name() const override { return "base_shift"; }
  int frame(const EffectData&) const override { return 0; }
  bool turns(const EffectData&) const override { return true; }
};

class ToolChange final : public FrameBySession {
 public:
  EffectInfo info() const override {
    return {
        .name = "tool_change",
        .description = "the tool sat otherwise on the flange in some sessions than in the first",
        .formula =
            "flange' = flange · shift, turn (one for each later session, or one from a session on)",
        .source =
            "Mooring, Roth, Driels: Fundamentals of manipulator calibration, 1991, on tool frames",
        .needs = {"session"},
        .ranges = {{.parameter = "shift_x_2", .unit = "m", .low = 1e-6, .high = 0.05},
                   {.parameter = "turn_x_2", .unit = "rad", .low = 1e-6, .high = 0.1}}};
  }
  std::string describe(const EffectVariant& variant, const Arm&) const override {
    return "the tool sitting otherwise" + sessions_of(variant);
  }

 private:
  std::string name() const override { return "tool_change"; }
  int frame(const EffectData& data) const override {
    return static_cast<int>(data.arm->joints().size()) + 1;
  }
  bool turns(const EffectData& data) const override { return data.has_rotation; }
};

/// Settings: "moment", how many rows came before it, and, where times were recorded, "time",
/// halfway between the rows before and after it. Predicted poses without a time come before or
/// after it by their covariate "row", their place in the record counted from 0, and without either
/// after it.
class ToolSlip final : public Effect {
 public:
  EffectInfo info() const override {
    return {.name = "tool_slip",
            .description = "the tool slipped on the flange at some moment, and stayed there",
            .formula = "flange' = flange · shift, turn in all rows after the moment",
            .source =
                "change of a mean at an unknown moment: Page: Continuous inspection schemes, 1954",
            .ranges = {{.parameter = "shift_x", .unit = "m", .low = 1e-6, .high = 0.05},
                       {.parameter = "turn_x", .unit = "rad", .low = 1e-6, .high = 0.1}}};
  }
  std::string describe(const EffectVariant& variant, const Arm&) const override {
    return "the tool slipping after row " +
           std::to_string(std::lround(setting_of(variant, "moment"))) +
           (variant.settings.contains("time") ? " in time" : "");
  }

  std::vector<EffectVariant> variants(const EffectData& data) const override {
    std::vector<int> moments;
    for (int m = kFewestRows; m + kFewestRows <= static_cast<int>(data.rows()); ++m) {
      if (parts(data, m)) moments.push_back(m);
    }
    const std::set<int> between = boundaries(data);
    const std::size_t step = (moments.size() + kMostMoments - 1) / kMostMoments;
    std::vector<EffectVariant> out;
    for (std::size_t i = 0; i < moments.size(); ++i) {
      // A slip between two sessions is a tool that was changed: no other moment is exactly that.
      if (i % step == 0 || between.contains(moments[i])) out.push_back(slip_at(moments[i], data));
    }
    return out;
  }

  std::vector<EffectVariant> between(const EffectVariant& lower, const EffectVariant& upper,
                                     const EffectData& data) const override {
    std::vector<EffectVariant> out;
    const auto end = static_cast<int>(upper.settings.at("moment"));
    for (int m = static_cast<int>(lower.settings.at("moment")) + 1; m < end; ++m) {
      if (parts(data, m)) out.push_back(slip_at(m, data));
    }
    return out;
  }

  Perturbations perturbations(const EffectVariant& variant, const EffectData& data) const override {
    Eigen::VectorXd after = Eigen::VectorXd::Zero(data.rows());
    const auto time = variant.settings.find("time");
    if (time != variant.settings.end() && data.has("time")) {
      after = (data.covariate("time").col(0).array() > time->second).cast<double>();
    } else if (data.recording) {
      const double moment = setting_of(variant, "moment");
      for (std::size_t i = 0; i < data.order.size(); ++i) {
        if (static_cast<double>(i) >= moment) after[data.order[i]] = 1.0;
      }
    } else if (data.has("row")) {
      after =
          (data.covariate("row").col(0).array() >= setting_of(variant, "moment")).cast<double>();
    } else {
      after.setOnes();
    }
    Perturbations out;
    const int flange = static_cast<int>(data.arm->joints().size()) + 1;
    for (int axis = 0; axis < static_cast<int>(variant.parameters.size()); ++axis) {
      out.push_back({move_frame(flange, axis, after)});
    }
    return out;
  }

 private:
  static EffectVariant slip_at(int moment, const EffectData& data) {
    EffectVariant variant{
        "tool_slip", -1, {{"moment", moment}}, shift_and_turn(data.has_rotation), "tool_slip"};
    if (data.has("time")) {
      variant.settings["time"] = 0.5 * (time_of(data, moment - 1) + time_of(data, moment));
    }
    return variant;
  }
  static double time_of(const EffectData& data, int place) {
    return data.covariate("time")(data.order[place], 0);
  }
  /// Moments between two sessions: each has all of its rows on one side.
  static std::set<int> boundaries(const EffectData& data) {
    std::set<int> out;
    if (!data.has("session")) return out;
    std::map<double, std::pair<int, int>> spans;  // first and last place in the order
    for (int i = 0; i < static_cast<int>(data.order.size()); ++i) {
      const double label = data.covariate("session")(data.order[i], 0);
      spans.try_emplace(label, i, i).first->second.second = i;
    }
    for (const auto& [label, span] : spans) {
      const int first = span.first;
      const bool parted = std::any_of(spans.begin(), spans.end(), [first](const auto& other) {
        return other.second.first < first && first <= other.second.second;
      });
      if (!parted) out.insert(first);
    }
    return out;
  }
  /// Rows of the same time cannot be on both sides.
  static bool parts(const EffectData& data, int moment) {
    return !data.has("time") || time_of(data, moment - 1) < time_of(data, moment);
  }
};

}  // namespace

std::shared_ptr<const Effect> base_shift() { return std::make_shared<BaseShift>(); }
std::shared_ptr<const Effect> tool_change() { return std::make_shared<ToolChange>(); }
std::shared_ptr<const Effect> tool_slip() { return std::make_shared<ToolSlip>(); }

}  // namespace bathyal::effects
