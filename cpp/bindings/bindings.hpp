// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pybind11/pybind11.h>

namespace bathyal::python {

// One function a room, called in floor order; inside: enums, options, results, classes, functions.
void bind_base(pybind11::module_& module);
void bind_geometry(pybind11::module_& module);
void bind_mesh_report(pybind11::module_& module);  // of the room geometry too, as the next three
void bind_rigid_body(pybind11::module_& module);
void bind_shape(pybind11::module_& module);
void bind_trajectory(pybind11::module_& module);
void bind_soundings(pybind11::module_& module);
void bind_xtf(pybind11::module_& module);  // the second file of soundings
void bind_terrain(pybind11::module_& module);
void bind_water_formulas(pybind11::module_& module);  // of the room water, as the next four
void bind_water_profile(pybind11::module_& module);
void bind_water_motion(pybind11::module_& module);
void bind_water(pybind11::module_& module);
void bind_sound_path(pybind11::module_& module);
void bind_scene(pybind11::module_& module);
void bind_toolpath(pybind11::module_& module);
void bind_arm(pybind11::module_& module);
void bind_world(pybind11::module_& module);
void bind_survey(pybind11::module_& module);  // of the room world, as the next one
void bind_generate(pybind11::module_& module);
void bind_sensors(pybind11::module_& module);  // of the room navigation, as the next one
void bind_navigation_filter(pybind11::module_& module);
void bind_workspace(pybind11::module_& module);
void bind_behavior_tree(pybind11::module_& module);
void bind_mission(pybind11::module_& module);
void bind_protocol(pybind11::module_& module);
void bind_vehicle(pybind11::module_& module);
void bind_devices(pybind11::module_& module);  // of the room vehicle, as the next one
void bind_vehicle_system(pybind11::module_& module);
void bind_sonar(pybind11::module_& module);
void bind_sidescan(pybind11::module_& module);
void bind_navigation(pybind11::module_& module);  // the second file of sonar
void bind_control(pybind11::module_& module);
void bind_uvms(pybind11::module_& module);
void bind_identify(pybind11::module_& module);
void bind_plan_touches(pybind11::module_& module);  // of the room identify, as the next one
void bind_verify(pybind11::module_& module);
void bind_diagnosis(pybind11::module_& module);

}  // namespace bathyal::python
