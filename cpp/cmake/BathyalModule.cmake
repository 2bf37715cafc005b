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
if(CMAKE_SYSTEM_PROCESSOR MATCHES "^(x86_64|AMD64|amd64)$")
  set(BATHYAL_X86 ON)
  target_compile_definitions(bathyal_flags INTERFACE BATHYAL_X86_KERNELS)
endif()
# New compilers bring new warnings: only those of the compiler it is developed with are errors.
if(BATHYAL_WERROR AND "${CMAKE_CXX_COMPILER_ID} ${CMAKE_CXX_COMPILER_VERSION}"
   MATCHES "^GNU 12\\.")
  target_compile_options(bathyal_flags INTERFACE -Werror)
endif()
if(BATHYAL_SANITIZE)
  if(BATHYAL_SANITIZE STREQUAL "thread")
    set(sanitizers -fsanitize=thread)
  elseif(BATHYAL_SANITIZE MATCHES "^(ON|address)$")
    set(sanitizers -fsanitize=address,undefined)
  else()
    message(FATAL_ERROR "BATHYAL_SANITIZE: expected address or thread, got ${BATHYAL_SANITIZE}")
  endif()
  target_compile_options(bathyal_flags INTERFACE ${sanitizers} -fno-sanitize-recover=all
                                                 -fno-omit-frame-pointer)
  target_link_options(bathyal_flags INTERFACE ${sanitizers})
endif()

# bathyal_simd_kernels(<variable> <prefix>)
# Sources <prefix>_baseline.cpp and, where they can be compiled, _avx2 and _avx512: one file an
# instruction set, chosen at run time (base/simd.hpp). The warnings are false alarms of GCC: on its
# own intrinsics' headers (bug 105593), and on vectors as template arguments.
function(bathyal_simd_kernels variable prefix)
  set(quiet -Wno-maybe-uninitialized -Wno-uninitialized -Wno-ignored-attributes -Wno-psabi)
  set(baseline ${quiet})
  set(kernels ${prefix}_baseline.cpp)
  if(BATHYAL_X86)
    list(APPEND kernels ${prefix}_avx2.cpp ${prefix}_avx512.cpp)
    set(baseline -march=x86-64-v2 ${quiet})
    set(avx2 -mavx2 -mfma -mbmi -mbmi2 ${quiet})
    set_source_files_properties(${prefix}_avx2.cpp PROPERTIES COMPILE_OPTIONS "${avx2}")
    set_source_files_properties(${prefix}_avx512.cpp PROPERTIES
      COMPILE_OPTIONS "${avx2};-mavx512f;-mavx512vl;-mavx512dq;-mavx512bw")
  endif()
  set_source_files_properties(${prefix}_baseline.cpp PROPERTIES COMPILE_OPTIONS "${baseline}")
  set(${variable} ${kernels} PARENT_SCOPE)
endfunction()

# bathyal_module(<name> SOURCES <files> [LINK <targets>])
# A static library bathyal_<name>, known to users as bathyal::<name>.
function(bathyal_module name)
  cmake_parse_arguments(ARG "" "" "SOURCES;LINK" ${ARGN})
  add_library(bathyal_${name} STATIC ${ARG_SOURCES})
  add_library(bathyal::${name} ALIAS bathyal_${name})
  set_target_properties(bathyal_${name} PROPERTIES EXPORT_NAME ${name}
                        UNITY_BUILD ${BATHYAL_UNITY} UNITY_BUILD_BATCH_SIZE 8)
  target_compile_features(bathyal_${name} PUBLIC cxx_std_20)
  target_include_directories(bathyal_${name} PUBLIC
    $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/cpp> $<INSTALL_INTERFACE:include>)
  target_link_libraries(bathyal_${name} PUBLIC ${ARG_LINK} PRIVATE $<BUILD_INTERFACE:bathyal_flags>)
  set_property(GLOBAL APPEND PROPERTY BATHYAL_MODULES bathyal_${name})
endfunction()
