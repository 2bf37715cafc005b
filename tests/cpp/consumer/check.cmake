# SPDX-License-Identifier: BSD-3-Clause
# cmake -DBUILD=<build tree> -DSOURCE=<this folder> -DWORK=<scratch> -P check.cmake
# Installs the build tree, then configures, builds and runs the consumer against it: the C++ and the
# CMake that the README and the page on installing show (tests/python/package/test_fragments.py).
function(run)
  execute_process(COMMAND ${ARGV} RESULT_VARIABLE status OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(NOT status EQUAL 0)
    message(FATAL_ERROR "${ARGV}\n${output}")
  endif()
  set(output "${output}" PARENT_SCOPE)
endfunction()

file(REMOVE_RECURSE ${WORK})
run(${CMAKE_COMMAND} --install ${BUILD} --prefix ${WORK}/prefix)
run(${CMAKE_COMMAND} -G Ninja -S ${SOURCE} -B ${WORK}/build -DCMAKE_PREFIX_PATH=${WORK}/prefix)
run(${CMAKE_COMMAND} --build ${WORK}/build)
run(${WORK}/build/consumer)
if(NOT output STREQUAL "triangle 0 at 5 m\n")
  message(FATAL_ERROR "the consumer says: ${output}")
endif()
run(${CMAKE_COMMAND} -G Ninja -S ${SOURCE}/headers -B ${WORK}/headers
    -DCMAKE_PREFIX_PATH=${WORK}/prefix)
run(${CMAKE_COMMAND} --build ${WORK}/headers)
