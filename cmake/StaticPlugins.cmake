# quell_link_static_plugins(target): with QUELL_STATIC_PLUGINS, links all plugins of this tree into the target and names a
# file that lists them as QUELL_STATIC_PLUGIN(name), one a line, in the macro QUELL_STATIC_PLUGIN_LIST. Otherwise nothing.
function(quell_link_static_plugins target)
  if(NOT QUELL_STATIC_PLUGINS)
    return()
  endif()
  get_property(names GLOBAL PROPERTY QUELL_PLUGIN_NAMES)
  list(TRANSFORM names REPLACE "(.+)" "QUELL_STATIC_PLUGIN(\\1)" OUTPUT_VARIABLE lines)
  list(JOIN lines "\n" text)
  file(CONFIGURE OUTPUT ${CMAKE_BINARY_DIR}/static_plugins.inc CONTENT "${text}\n")
  target_compile_definitions(${target} PRIVATE QUELL_STATIC_PLUGIN_LIST="${CMAKE_BINARY_DIR}/static_plugins.inc")
  target_link_libraries(${target} PRIVATE ${names})
endfunction()
