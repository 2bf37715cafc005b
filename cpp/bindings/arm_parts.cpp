// SPDX-License-Identifier: BSD-3-Clause
#include "arm_parts.hpp"

#include <pybind11/stl.h>

#include <set>
#include <string>
#include <utility>
#include <vector>

#include "arrays.hpp"
#include "bathyal/arm/chain.hpp"
#include "bathyal/base/error.hpp"
#include "rigid_body.hpp"

namespace bathyal::python {
namespace {

// From Python -----------------------------------------------------------------------------------

/// A dict whose values are taken one by one; what nobody took is a mistake.
class Fields {
 public:
  Fields(std::string where, const py::handle& object) : where_(std::move(where)) {
    if (!py::isinstance<py::dict>(object)) {
      throw_argument(where_, "a dict", py::str(py::type::handle_of(object)).cast<std::string>());
    }
    dict_ = py::reinterpret_borrow<py::dict>(object);
  }

  /// Name of a field, for messages.
  std::string name(const char* key) const { return where_.empty() ? key : where_ + " " + key; }

  void where(const std::string& name) {
    if (!name.empty()) where_ += " " + name;
  }

  py::object take(const char* key) {
    taken_.insert(key);
    return dict_.contains(key) ? py::object(dict_[key]) : py::none();
  }

  template <class Value>
  void take(const char* key, Value& value) {
    const py::object object = take(key);
    if (object.is_none()) return;
    try {
      value = object.cast<Value>();
    } catch (const py::cast_error&) {
      constexpr bool text = std::is_same_v<Value, std::string>;
      throw_argument(name(key), text ? "text" : "a number", py::repr(object).cast<std::string>());
    }
  }

  void take(const char* key, Pose& pose) { pose = pose_argument(name(key), take(key)); }

  void take(const char* key, Vec3& vector) {
    const py::object object = take(key);
    if (!object.is_none()) vector = vector_argument(name(key), object);
  }

  void take(const char* key, Eigen::Matrix3d& matrix) {
    const py::object object = take(key);
    if (!object.is_none()) matrix = square_argument(name(key), object, 3);
  }

  void take(const char* key, std::vector<Shape>& shapes) {
    const py::object object = take(key);
    if (object.is_none()) return;
    try {
      shapes = object.cast<std::vector<Shape>>();
    } catch (const py::cast_error&) {
      throw_argument(name(key), "a list of Shapes", py::repr(object).cast<std::string>());
    }
  }

  py::list list(const char* key) {
    const py::object object = take(key);
    if (object.is_none()) return py::list();
    if (!py::isinstance<py::list>(object)) {
      throw_argument(name(key), "a list", py::repr(object).cast<std::string>());
    }
    return object;
  }

  void finish() const {
    for (const auto& [key, value] : dict_) {
      const std::string text = py::str(key);
      if (!taken_.contains(text)) throw_argument(where_, "no key that is not known", text);
    }
  }

 private:
  std::string where_;
  py::dict dict_;
  std::set<std::string> taken_;
};

Joint take_joint(Fields& fields) {
  Joint joint;
  fields.take("name", joint.name);
  fields.where(joint.name);
  std::string type = enum_name(joint.type, type_names());
  fields.take("type", type);
  joint.type = enum_argument(fields.name("type"), type, type_names());
  fields.take("a", joint.row.a);
  fields.take("alpha", joint.row.alpha);
  fields.take("d", joint.row.d);
  fields.take("theta", joint.row.theta);
  fields.take("beta", joint.row.beta);
  fields.take("coordinate", joint.coordinate);
  fields.take("follows", joint.follows);
  fields.take("multiplier", joint.multiplier);
  fields.take("offset", joint.offset);
  fields.take("lower", joint.lower);
  fields.take("upper", joint.upper);
  fields.take("velocity", joint.velocity);
  fields.take("effort", joint.effort);
  return joint;
}

Link take_link(Fields& fields) {
  Link link;
  fields.take("name", link.name);
  fields.where(link.name);
  fields.take("frame", link.row_from_link);
  fields.take("mass", link.body.mass);
  fields.take("center_of_mass", link.body.center_of_mass);
  fields.take("inertia", link.body.inertia);
  fields.take("volume", link.body.volume);
  fields.take("center_of_buoyancy", link.body.center_of_buoyancy);
  fields.take("collision", link.collision);
  fields.take("visual", link.visual);
  for (const py::handle& frame_object : fields.list("frames")) {
    Fields frame("frame", frame_object);
    Frame& added = link.frames.emplace_back();
    frame.take("name", added.name);
    frame.take("pose", added.link_from_frame);
    frame.finish();
  }
  return link;
}

ChainLink take_chain_link(const py::handle& object) {
  Fields fields("link", object);
  ChainLink link{take_link(fields), {}};
  for (const py::handle& body_object : fields.list("attached")) {
    Fields attached("attached", body_object);
    Attached& added = link.attached.emplace_back();
    attached.take("pose", added.link_from_body);
    Fields body("link", attached.take("body"));
    added.body = take_link(body);
    body.finish();
    attached.finish();
  }
  fields.finish();
  return link;
}

JointChain take_chain(Fields& fields) {
  JointChain chain;
  fields.take("name", chain.name);
  for (const py::handle& object : fields.list("joints")) {
    Fields joint("joint", object);
    ChainJoint& added = chain.joints.emplace_back();
    added.joint = take_joint(joint);
    joint.take("origin", added.parent_from_joint);
    joint.take("axis", added.axis);
    joint.finish();
  }
  for (const py::handle& object : fields.list("links"))
    chain.links.push_back(take_chain_link(object));
  return chain;
}

Arm arm_from_chain_python(const py::dict& object, double nearly_parallel) {
  Fields fields("", object);
  const JointChain chain = take_chain(fields);
  std::string source;
  fields.take("source", source);
  fields.finish();
  Arm arm = arm_from_chain(chain, {nearly_parallel});
  arm.set_source(std::move(source));
  return arm;
}

// To Python -------------------------------------------------------------------------------------

py::dict joint_parts(const Joint& joint) {
  py::dict parts;
  parts["name"] = joint.name;
  parts["type"] = enum_name(joint.type, type_names());
  parts["coordinate"] = joint.coordinate;
  parts["follows"] = joint.follows;
  parts["multiplier"] = joint.multiplier;
  parts["offset"] = joint.offset;
  parts["lower"] = joint.lower;
  parts["upper"] = joint.upper;
  parts["velocity"] = joint.velocity;
  parts["effort"] = joint.effort;
  return parts;
}

py::dict link_parts(const Link& link) {
  py::dict parts;
  parts["name"] = link.name;
  parts["mass"] = link.body.mass;
  parts["center_of_mass"] = to_numpy(link.body.center_of_mass);
  parts["inertia"] = to_numpy(link.body.inertia);
  parts["volume"] = link.body.volume;
  parts["center_of_buoyancy"] = to_numpy(link.body.center_of_buoyancy);
  parts["collision"] = link.collision;
  parts["visual"] = link.visual;
  return parts;
}

py::dict chain_parts(const JointChain& chain) {
  py::list joints, links;
  for (const ChainJoint& joint : chain.joints) {
    py::dict joint_dict = joint_parts(joint.joint);
    joint_dict["origin"] = to_numpy(joint.parent_from_joint);
    joint_dict["axis"] = to_numpy(joint.axis);
    joints.append(joint_dict);
  }
  for (const ChainLink& link : chain.links) {
    py::dict link_dict = link_parts(link.link);
    py::list bodies;
    for (const Attached& attached : link.attached) {
      py::dict body;
      body["pose"] = to_numpy(attached.link_from_body);
      body["body"] = link_parts(attached.body);
      bodies.append(body);
    }
    link_dict["attached"] = bodies;
    links.append(link_dict);
  }
  py::dict parts;
  parts["name"] = chain.name;
  parts["joints"] = joints;
  parts["links"] = links;
  return parts;
}

}  // namespace

const EnumNames<JointType>& type_names() {
  static const EnumNames<JointType> names{{"revolute", JointType::kRevolute},
                                          {"prismatic", JointType::kPrismatic},
                                          {"fixed", JointType::kFixed}};
  return names;
}

py::dict arm_parts(const Arm& arm) {
  py::list joints, links;
  for (const Joint& joint : arm.joints()) {
    py::dict joint_dict = joint_parts(joint);
    joint_dict["a"] = joint.row.a;
    joint_dict["alpha"] = joint.row.alpha;
    joint_dict["d"] = joint.row.d;
    joint_dict["theta"] = joint.row.theta;
    joint_dict["beta"] = joint.row.beta;
    joints.append(joint_dict);
  }
  for (const Link& link : arm.links()) {
    py::dict link_dict = link_parts(link);
    link_dict["frame"] = to_numpy(link.row_from_link);
    py::list frames;
    for (const Frame& frame : link.frames) {
      py::dict named;
      named["name"] = frame.name;
      named["pose"] = to_numpy(frame.link_from_frame);
      frames.append(named);
    }
    link_dict["frames"] = frames;
    links.append(link_dict);
  }
  py::dict parts;
  parts["name"] = arm.name();
  parts["source"] = arm.source();
  parts["root"] = to_numpy(arm.root());
  parts["joints"] = joints;
  parts["links"] = links;
  parts["flange"] = to_numpy(arm.flange());
  parts["base"] = to_numpy(arm.base());
  parts["tool"] = to_numpy(arm.tool());
  return parts;
}

Arm arm_from_parts(const py::dict& parts) {
  Fields fields("", parts);
  std::string name, source;
  Pose root, flange, base, tool;
  fields.take("name", name);
  fields.take("source", source);
  fields.take("root", root);
  fields.take("flange", flange);
  fields.take("base", base);
  fields.take("tool", tool);
  std::vector<Joint> joints;
  for (const py::handle& object : fields.list("joints")) {
    Fields joint("joint", object);
    joints.push_back(take_joint(joint));
    joint.finish();
  }
  std::vector<Link> links;
  for (const py::handle& object : fields.list("links")) {
    Fields link("link", object);
    links.push_back(take_link(link));
    link.finish();
  }
  fields.finish();
  Arm arm(std::move(name), std::move(joints), std::move(links), root, flange);
  arm.set_source(std::move(source));
  arm.set_base(base);
  arm.set_tool(tool);
  return arm;
}

void bind_arm_parts(py::module_& module) {
  module.def("arm_from_chain", &arm_from_chain_python, py::arg("chain"), py::kw_only(),
             py::arg("nearly_parallel") = ChainOptions().nearly_parallel,
             "The Arm of joint origins, axes and links: what a URDF describes.");
  module.def(
      "chain_from_arm", [](const Arm& arm) { return chain_parts(chain_from_arm(arm)); },
      py::arg("arm"), "Joint origins, axes and links of an Arm; the last joint is the flange's.");
  module.def("arm_parts", &arm_parts, py::arg("arm"), "Everything an Arm is made of.");
  module.def("arm_from_parts", &arm_from_parts, py::arg("parts"), "The Arm of such a dict.");
}

}  // namespace bathyal::python
