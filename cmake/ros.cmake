# What knows ROS: the node library and its programs, and their tests. src/node/main.cpp is the node's main
# program, the rest of src/node its library; src/tools is trajectory_client.

function(imd_link_ros target)
  target_include_directories(${target} SYSTEM PUBLIC ${CATKIN_DEVEL_PREFIX}/include ${catkin_INCLUDE_DIRS})
  target_compile_definitions(${target} PUBLIC BOOST_BIND_GLOBAL_PLACEHOLDERS)
  target_link_libraries(${target} PUBLIC imd_settings ${catkin_LIBRARIES} Threads::Threads)
  add_dependencies(${target} ${PROJECT_NAME}_generate_messages_cpp ${catkin_EXPORTED_TARGETS})
endfunction()

# Programs go where roslaunch and rosrun look for them.
function(imd_add_ros_program name)
  add_executable(${name} ${ARGN})
  set_target_properties(${name} PROPERTIES
    RUNTIME_OUTPUT_DIRECTORY ${CATKIN_DEVEL_PREFIX}/${CATKIN_PACKAGE_BIN_DESTINATION})
  imd_link_ros(${name})
  install(TARGETS ${name} RUNTIME DESTINATION ${CATKIN_PACKAGE_BIN_DESTINATION})
endfunction()

function(imd_add_programs)
  set(main ${PROJECT_SOURCE_DIR}/src/node/main.cpp)
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/src/node/*.cpp)
  list(FIND sources ${main} has_main)
  list(REMOVE_ITEM sources ${main})
  if(sources)
    add_library(imd_node STATIC ${sources})
    imd_link_ros(imd_node)
    target_link_libraries(imd_node PUBLIC imd_hardware imd_command_line)
    if(NOT has_main EQUAL -1)
      imd_add_ros_program(driver_node ${main})
      target_link_libraries(driver_node PUBLIC imd_node)
    endif()
  endif()

  file(GLOB_RECURSE sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/src/tools/*.cpp)
  if(sources)
    imd_add_ros_program(trajectory_client ${sources})
    target_link_libraries(trajectory_client PUBLIC imd_command_line)
  endif()
endfunction()

# src/plot: the program `plot`, and its modules in a folder beside it. Its source is not executable: rosrun would find two.
function(imd_add_plot)
  catkin_install_python(PROGRAMS src/plot/plot DESTINATION ${CATKIN_PACKAGE_BIN_DESTINATION})
  install(DIRECTORY src/plot/plotting DESTINATION ${CATKIN_PACKAGE_BIN_DESTINATION} FILES_MATCHING PATTERN "*.py")
endfunction()

# A man page of each program, made of what it says with --help. A build for another machine cannot run them and has none.
function(imd_add_man_pages)
  if(CMAKE_CROSSCOMPILING OR IMD_SANITIZE)
    return()
  endif()
  set(folder ${PROJECT_BINARY_DIR}/man)
  file(MAKE_DIRECTORY ${folder})
  set(maker ${PROJECT_SOURCE_DIR}/cmake/man_page.py)
  file(GLOB plot CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/src/plot/plot ${PROJECT_SOURCE_DIR}/src/plot/plotting/*.py)
  foreach(name driver_node trajectory_client emulated_drives drive_tool plot)
    set(program ${PYTHON_EXECUTABLE} ${PROJECT_SOURCE_DIR}/src/plot/plot)
    set(needed ${plot})
    if(TARGET ${name})
      set(program $<TARGET_FILE:${name}>)
      set(needed ${name})
    endif()
    add_custom_command(OUTPUT ${folder}/${name}.1 COMMAND ${PYTHON_EXECUTABLE} ${maker} ${program} > ${folder}/${name}.1
                       DEPENDS ${needed} ${maker} VERBATIM)
    list(APPEND pages ${folder}/${name}.1)
  endforeach()
  add_custom_target(man_pages ALL DEPENDS ${pages})
  install(FILES ${pages} DESTINATION ${CATKIN_GLOBAL_SHARE_DESTINATION}/man/man1)
endfunction()

function(imd_add_packaging_tests)
  file(GLOB sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/test/packaging/*_test.cpp)
  imd_add_gtest(packaging_tests "${sources}")
  imd_link_ros(packaging_tests)

  file(GLOB python_tests CONFIGURE_DEPENDS RELATIVE ${PROJECT_SOURCE_DIR} ${PROJECT_SOURCE_DIR}/test/*/*_test.py)
  list(FILTER python_tests EXCLUDE REGEX "^test/(node|socketcan|real_buses|programs)/")
  foreach(file IN LISTS python_tests)
    get_filename_component(name ${file} NAME_WE)
    set(xml pytest-${name}.xml)
    catkin_run_tests_target("pytest" ${name} ${xml} WORKING_DIRECTORY ${PROJECT_SOURCE_DIR}
      COMMAND "${PYTHON_EXECUTABLE} -B -m pytest -q -p no:cacheprovider ${file} --junitxml=${CATKIN_TEST_RESULTS_DIR}/${PROJECT_NAME}/${xml}")
  endforeach()
endfunction()

# test/node: *_test.cpp of the node library (node_tests), and rostests: X.test, with X.cpp as its GoogleTest program `X` if there
# is one (X must not end in _test).
function(imd_add_node_tests)
  file(GLOB sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/test/node/*_test.cpp)
  if(sources AND TARGET imd_node)
    imd_add_gtest(node_tests "${sources}" imd_node)
  endif()

  file(GLOB tests CONFIGURE_DEPENDS RELATIVE ${PROJECT_SOURCE_DIR} ${PROJECT_SOURCE_DIR}/test/node/*.test)
  foreach(test IN LISTS tests)
    get_filename_component(name ${test} NAME_WE)
    set(needs driver_node)
    if(EXISTS ${PROJECT_SOURCE_DIR}/test/node/${name}.cpp)
      imd_add_rostest_program(${name})
      list(APPEND needs ${name})
    endif()
    add_rostest(${test} DEPENDENCIES ${needs})
    # They watch the clock: nothing else may run beside them.
    set_tests_properties(_ctest_${PROJECT_NAME}_rostest_test_node_${name}.test PROPERTIES RUN_SERIAL TRUE TIMEOUT 300)
  endforeach()
endfunction()

function(imd_add_rostest_program name)
  add_executable(${name} EXCLUDE_FROM_ALL ${PROJECT_SOURCE_DIR}/test/node/${name}.cpp)
  set_target_properties(${name} PROPERTIES
    RUNTIME_OUTPUT_DIRECTORY ${CATKIN_DEVEL_PREFIX}/${CATKIN_PACKAGE_BIN_DESTINATION})
  target_include_directories(${name} PRIVATE ${PROJECT_SOURCE_DIR}/test)
  target_compile_definitions(${name} PRIVATE IMD_SOURCE_DIR="${PROJECT_SOURCE_DIR}")
  imd_link_ros(${name})
  target_link_libraries(${name} PUBLIC fmt::fmt yaml-cpp GTest::GTest)
  add_dependencies(tests ${name})
endfunction()

# test/programs: Python tests of the programs as a user calls them, without a driver or with a master of their own.
function(imd_add_program_tests)
  set(programs ${CATKIN_DEVEL_PREFIX}/${CATKIN_PACKAGE_BIN_DESTINATION})
  set(xml pytest-programs.xml)
  catkin_run_tests_target("pytest" programs ${xml} DEPENDENCIES driver_node trajectory_client emulated_drives drive_tool
    COMMAND "env IMD_PROGRAMS=${programs} ${PYTHON_EXECUTABLE} -B -m pytest -q -p no:cacheprovider ${PROJECT_SOURCE_DIR}/test/programs --junitxml=${CATKIN_TEST_RESULTS_DIR}/${PROJECT_NAME}/${xml}")
endfunction()
