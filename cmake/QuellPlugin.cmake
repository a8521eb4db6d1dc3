# quell_add_plugin(name source…): builds the plugin library of node type `name`.
#
# In this tree and out of it. With QUELL_STATIC_PLUGINS the same sources become an object library whose table function is
# called quell_plugin_<name>, to be linked into one binary. Sources called *_kernels.cpp may contract a*b+c.
function(quell_add_plugin name)
  if(QUELL_STATIC_PLUGINS)
    add_library(${name} OBJECT ${ARGN})
    target_compile_definitions(${name} PRIVATE QUELL_PLUGIN_SYMBOL=quell_plugin_${name})
    set_property(GLOBAL APPEND PROPERTY QUELL_STATIC_PLUGIN_NAMES ${name})
  else()
    add_library(${name} MODULE ${ARGN})
    set_target_properties(${name} PROPERTIES PREFIX "" SUFFIX ".so")
    if(QUELL_PLUGIN_OUTPUT_DIRECTORY)
      set_target_properties(${name} PROPERTIES LIBRARY_OUTPUT_DIRECTORY ${QUELL_PLUGIN_OUTPUT_DIRECTORY})
    endif()
  endif()
  target_link_libraries(${name} PRIVATE Quell::sdk)
  foreach(source ${ARGN})
    if(NOT source MATCHES "_kernels\\.cpp$")
      set_property(SOURCE ${source} APPEND PROPERTY COMPILE_OPTIONS -ffp-contract=off)
    endif()
  endforeach()
endfunction()
