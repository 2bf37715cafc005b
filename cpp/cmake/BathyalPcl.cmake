# SPDX-License-Identifier: BSD-3-Clause
# PCL, where it is there and wanted, and `bathyal_pcl_module`: a room's part that needs it, as a
# library of its own so that nothing else drags in PCL and, with its surface library, VTK. PCL's ABI
# changes with the vector instructions allowed: no -m flags here, ever.
set(BATHYAL_PCL "AUTO" CACHE STRING "What needs PCL: ON, OFF or AUTO")
set_property(CACHE BATHYAL_PCL PROPERTY STRINGS AUTO ON OFF)

set(PCL_FOUND FALSE)
if(NOT BATHYAL_PCL STREQUAL "OFF")
  set(pcl_wish QUIET)
  if(BATHYAL_PCL STREQUAL "ON")
    set(pcl_wish REQUIRED)
  endif()
  set(CMAKE_MESSAGE_LOG_LEVEL WARNING)  # PCL's own finders talk, QUIET or not
  find_package(PCL 1.12 ${pcl_wish} COMPONENTS common kdtree search surface registration)
  unset(CMAKE_MESSAGE_LOG_LEVEL)
endif()

# bathyal_pcl_module(<name> SOURCES <files> LINK <targets> PCL <libraries>); nothing without PCL.
function(bathyal_pcl_module name)
  if(NOT PCL_FOUND)
    return()
  endif()
  cmake_parse_arguments(ARG "" "" "SOURCES;LINK;PCL" ${ARGN})
  bathyal_module(${name} SOURCES ${ARG_SOURCES} LINK ${ARG_LINK})
  target_include_directories(bathyal_${name} SYSTEM PRIVATE ${PCL_INCLUDE_DIRS})
  # GCC 12's false alarm on PCL's own transforms, which are inlined here.
  target_compile_options(bathyal_${name} PRIVATE -Wno-array-bounds)
  # By file: PCL's imported targets would pull in all of VTK.
  foreach(library IN LISTS ARG_PCL)
    string(TOUPPER ${library} library)
    target_link_libraries(bathyal_${name} PRIVATE ${PCL_${library}_LIBRARY})
  endforeach()
endfunction()
