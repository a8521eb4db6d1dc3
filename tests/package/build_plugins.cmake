# Installs BUILD to a prefix, moves the prefix, builds the plugins of SOURCE against it with GENERATOR in WORK/build, and
# runs a graph of them with the installed program.
function(run)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE status OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(NOT status EQUAL 0)
    list(JOIN ARGN " " command)
    message(FATAL_ERROR "${command}\n${output}")
  endif()
endfunction()

file(REMOVE_RECURSE ${WORK})
run(${CMAKE_COMMAND} --install ${BUILD} --prefix ${WORK}/first)
file(RENAME ${WORK}/first ${WORK}/prefix)
# The sources leave the tree, so that nothing of it is found by accident.
file(COPY ${SOURCE}/package/plugins ${SOURCE}/core/plugins/negate.c DESTINATION ${WORK})
file(RENAME ${WORK}/negate.c ${WORK}/plugins/negate.c)
# The example of the README is a plugin like any other.
file(READ ${SOURCE}/../README.md readme)
string(FIND "${readme}" "```cpp\n" begin)
string(SUBSTRING "${readme}" ${begin} -1 readme)
string(FIND "${readme}" "\n```" length)
math(EXPR length "${length} - 6")
string(SUBSTRING "${readme}" 7 ${length} example)
file(WRITE ${WORK}/plugins/dim.cpp "${example}")
run(${CMAKE_COMMAND} -S ${WORK}/plugins -B ${WORK}/build -G ${GENERATOR} -DCMAKE_PREFIX_PATH=${WORK}/prefix
    -DCMAKE_C_COMPILER=${C_COMPILER} -DCMAKE_CXX_COMPILER=${CXX_COMPILER} -DCMAKE_BUILD_TYPE=Release
    -DCMAKE_C_FLAGS=${FLAGS} -DCMAKE_CXX_FLAGS=${FLAGS})
run(${CMAKE_COMMAND} --build ${WORK}/build)
run(${WORK}/prefix/bin/quell run ${WORK}/plugins/darkened.json room --source width=48 --source height=32 --frames 3
    --plugins ${WORK}/build --float -o "${WORK}/out/image.####.exr")
