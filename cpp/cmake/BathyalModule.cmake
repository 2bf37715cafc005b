# SPDX-License-Identifier: BSD-3-Clause
# How every target of the project is compiled, and `bathyal_module`, which declares one room.

if(NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CONFIGURATION_TYPES)
  set(CMAKE_BUILD_TYPE Release CACHE STRING "" FORCE)
endif()
set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_POSITION_INDEPENDENT_CODE ON)
set(CMAKE_CXX_VISIBILITY_PRESET hidden)
set(CMAKE_VISIBILITY_INLINES_HIDDEN ON)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)

find_program(CCACHE_PROGRAM ccache)
if(CCACHE_PROGRAM)
  set(CMAKE_CXX_COMPILER_LAUNCHER "${CCACHE_PROGRAM}")
endif()

add_library(bathyal_flags INTERFACE)
# Contraction is off everywhere: a fused multiply-add on one machine and not on another would
# change the last bit of a decision, and results must be the same bytes on every SIMD path.
target_compile_options(bathyal_flags INTERFACE -ffp-contract=off -Wall -Wextra -Wconversion
                                               -Wno-sign-conversion)
if(BATHYAL_WERROR)
  target_compile_options(bathyal_flags INTERFACE -Werror)
endif()
if(BATHYAL_SANITIZE)
  target_compile_options(bathyal_flags INTERFACE -fsanitize=address,undefined
                                                 -fno-sanitize-recover=all -fno-omit-frame-pointer)
  target_link_options(bathyal_flags INTERFACE -fsanitize=address,undefined)
endif()

# bathyal_module(<name> SOURCES <files> [LINK <targets>])
# A static library bathyal_<name>, known to users as bathyal::<name>.
function(bathyal_module name)
  cmake_parse_arguments(ARG "" "" "SOURCES;LINK" ${ARGN})
  add_library(bathyal_${name} STATIC ${ARG_SOURCES})
  add_library(bathyal::${name} ALIAS bathyal_${name})
  set_target_properties(bathyal_${name} PROPERTIES EXPORT_NAME ${name})
  target_compile_features(bathyal_${name} PUBLIC cxx_std_20)
  target_include_directories(bathyal_${name} PUBLIC
    $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/cpp> $<INSTALL_INTERFACE:include>)
  target_link_libraries(bathyal_${name} PUBLIC ${ARG_LINK} PRIVATE $<BUILD_INTERFACE:bathyal_flags>)
  set_property(GLOBAL APPEND PROPERTY BATHYAL_MODULES bathyal_${name})
endfunction()
