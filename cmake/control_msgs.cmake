# Debian's ROS 1 has no control_msgs: there the folder control_msgs/, a catkin package of its own with the same fields, is built
# along with the driver. Where one is installed, or was added by the workspace before us, that one is used.

# Sets `result` to the directory of an installed control_msgs, or to "". What an earlier run of CMake left in the devel space does
# not count; find_package() cannot tell, and would define the targets that the folder is about to define.
function(imd_find_foreign_control_msgs result)
  set(${result} "" PARENT_SCOPE)
  foreach(prefix IN LISTS CMAKE_PREFIX_PATH CMAKE_SYSTEM_PREFIX_PATH)
    file(GLOB configs ${prefix}/share/control_msgs/cmake/control_msgsConfig.cmake
                      ${prefix}/lib/cmake/control_msgs/control_msgsConfig.cmake
                      ${prefix}/lib/*/cmake/control_msgs/control_msgsConfig.cmake)
    foreach(config IN LISTS configs)
      file(STRINGS ${config} own REGEX "control_msgs_SOURCE_PREFIX ${PROJECT_SOURCE_DIR}/control_msgs\\)")
      if(NOT own)
        get_filename_component(directory ${config} DIRECTORY)
        set(${result} ${directory} PARENT_SCOPE)
        return()
      endif()
    endforeach()
  endforeach()
endfunction()

macro(imd_provide_control_msgs)
  imd_find_foreign_control_msgs(imd_foreign_control_msgs)
  if(TARGET control_msgs_generate_messages)
    message(STATUS "control_msgs: built by this workspace")
  elseif(imd_foreign_control_msgs)
    message(STATUS "control_msgs: ${imd_foreign_control_msgs}")
  else()
    message(STATUS "control_msgs: none is installed, building ${PROJECT_SOURCE_DIR}/control_msgs")
    add_subdirectory(control_msgs)
    imd_add_source_space(${PROJECT_SOURCE_DIR}/control_msgs)
  endif()
endmacro()

# rosmsg and rospack look below the source spaces that the marker file of the devel space lists, but not inside packages.
function(imd_add_source_space directory)
  file(READ ${CATKIN_DEVEL_PREFIX}/.catkin spaces)
  if(NOT directory IN_LIST spaces)
    file(APPEND ${CATKIN_DEVEL_PREFIX}/.catkin ";${directory}")
  endif()
endfunction()

# Tests run in the environment that catkin cached when it was found: before there was a folder of Python messages, or control_msgs.
macro(imd_refresh_test_environment)
  execute_process(COMMAND ${GENERATE_ENVIRONMENT_CACHE_COMMAND} RESULT_VARIABLE imd_refresh_failed)
  if(imd_refresh_failed)
    message(FATAL_ERROR "the environment of the tests cannot be cached: ${GENERATE_ENVIRONMENT_CACHE_COMMAND}")
  endif()
endmacro()
