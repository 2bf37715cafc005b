// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/diagnosis/arm/internal/descriptions.hpp"

#include <cmath>
#include <functional>
#include <map>

#include "bathyal/base/error.hpp"
#include "bathyal/base/text.hpp"

namespace bathyal::diagnosis {
namespace {

std::string joint_description(int coordinate, const Arm& arm) {
  std::string text = "joint " + std::to_string(coordinate + 1);
  for (const Joint& joint : arm.joints()) {
    if (joint.type != JointType::kFixed && joint.coordinate == coordinate) {
      if (!joint.name.empty() && joint.name != "joint_" + std::to_string(coordinate + 1)) {
        text += " (" + joint.name + ")";
      }
      break;
    }
  }
  return text;
}

std::string session_description(const EffectVariant& variant, const std::string& what) {
  const auto from = variant.settings.find("from");
  if (from == variant.settings.end()) return what + " in each session by itself";
  return what + " from session " + to_text(from->second) + " on";
}

}  // namespace

std::string description_of(const EffectVariant& variant, const Arm& arm) {
  const std::string joint = variant.joint >= 0 ? joint_description(variant.joint, arm) : "";
  const auto setting = [&](const char* name) {
    const auto at = variant.settings.find(name);
    return at == variant.settings.end() ? 0.0 : at->second;
  };
  const std::map<std::string, std::function<std::string()>> sentences{
      {"joint_harmonic",
       [&] { return "a wave of order " + three_digits(setting("order")) + " along " + joint; }},
      {"joint_map", [&] { return "a periodic curve along " + joint; }},
      {"joint_scale", [&] { return "a wrong scale of " + joint; }},
      {"joint_coupling",
       [&] {
         return joint + " moved along by " +
                joint_description(static_cast<int>(setting("by")), arm);
       }},
      {"backlash", [&] { return "play in " + joint; }},
      {"joint_compliance", [&] { return joint + " giving way under gravity"; }},
      {"link_compliance",
       [&] { return "the link that " + joint + " moves bending under its load"; }},
      {"payload",
       [&] { return std::string("joints giving way under load, as by a mass at the tool"); }},
      {"base_shift",
       [&] { return session_description(variant, "the base, or the tracker, moved"); }},
      {"base_compliance", [&] { return std::string("the base tilting under the arm's weight"); }},
      {"tool_slip",
       [&] {
         return "the tool slipping after row " + std::to_string(std::lround(setting("moment"))) +
                (variant.settings.contains("time") ? " in time" : "");
       }},
      {"tool_change", [&] { return session_description(variant, "the tool sitting otherwise"); }},
      {"thermal", [&] { return std::string("links growing with temperature"); }},
      {"drift", [&] { return std::string("the base, or the tracker, drifting with time"); }},
      {"clock_shift", [&] { return std::string("clocks of joints and tracker out of step"); }},
  };
  const auto known = sentences.find(variant.effect);
  if (known != sentences.end()) return known->second();
  return joint.empty() ? variant.effect : variant.effect + " of " + joint;
}

bool has_whole_order(const EffectVariant& variant) {
  const auto order = variant.settings.find("order");
  return order != variant.settings.end() && order->second == std::round(order->second);
}

}  // namespace bathyal::diagnosis
