# What runs on SocketCAN outside of the stages: the program emulated_drives, and tests across the kernel.

# The transports use Boost.Asio: headers, Boost.System, and threads for older C libraries.
function(imd_link_transports)
  find_package(Threads REQUIRED)
  target_include_directories(imd_transport SYSTEM PUBLIC ${Boost_INCLUDE_DIRS})
  target_link_libraries(imd_transport PUBLIC Boost::system Threads::Threads)
endfunction()

# src/NAME: a program without ROS, but where rosrun finds it. Further arguments are libraries.
function(imd_add_plain_program name)
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/src/${name}/*.cpp)
  add_executable(${name} ${sources})
  set_target_properties(${name} PROPERTIES
    RUNTIME_OUTPUT_DIRECTORY ${CATKIN_DEVEL_PREFIX}/${CATKIN_PACKAGE_BIN_DESTINATION})
  target_link_libraries(${name} PRIVATE ${ARGN} imd_hardware imd_command_line)
  install(TARGETS ${name} RUNTIME DESTINATION ${CATKIN_PACKAGE_BIN_DESTINATION})
endfunction()

# Registers a test that needs CAN in the kernel, and so runs within scripts/with_vcan; the result file follows `result_option`.
function(imd_add_vcan_test type name result_option command)
  set(xml ${type}-${name}.xml)
  catkin_run_tests_target(${type} ${name} ${xml} DEPENDENCIES ${ARGN}
    COMMAND "${PROJECT_SOURCE_DIR}/scripts/with_vcan --timeout 500 ${command} ${result_option}${CATKIN_TEST_RESULTS_DIR}/${PROJECT_NAME}/${xml}")
  # They watch the clock.
  set_tests_properties(_ctest_${PROJECT_NAME}_${type}_${name} PROPERTIES RUN_SERIAL TRUE)
endfunction()

# test/socketcan: a GoogleTest program, which makes interfaces of its own, and Python tests of programs. test/real_buses: the driver
# and emulated drives in two programs, and programs of others beside them.
function(imd_add_socketcan_tests)
  file(GLOB sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/test/socketcan/*.cpp)
  add_executable(socketcan_tests EXCLUDE_FROM_ALL ${sources})
  set_target_properties(socketcan_tests PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR})
  target_include_directories(socketcan_tests PRIVATE ${PROJECT_SOURCE_DIR}/test)
  target_link_libraries(socketcan_tests PRIVATE imd_transport GTest::GTest GTest::Main)
  add_dependencies(tests socketcan_tests)
  imd_add_vcan_test(gtest socketcan_tests --gtest_output=xml: ${PROJECT_BINARY_DIR}/socketcan_tests socketcan_tests)

  set(programs ${CATKIN_DEVEL_PREFIX}/${CATKIN_PACKAGE_BIN_DESTINATION})
  set(pytest "env IMD_EMULATED_DRIVES=${programs}/emulated_drives IMD_DRIVE_TOOL=${programs}/drive_tool ${PYTHON_EXECUTABLE} -B -m pytest -q -p no:cacheprovider ${PROJECT_SOURCE_DIR}/test")
  imd_add_vcan_test(pytest emulated_drives_test --junitxml= "${pytest}/socketcan/emulated_drives_test.py" emulated_drives)
  imd_add_vcan_test(pytest drive_tool_test --junitxml= "${pytest}/socketcan/drive_tool_test.py" emulated_drives drive_tool)
  imd_add_vcan_test(pytest real_buses --junitxml= "${pytest}/real_buses" emulated_drives driver_node)
endfunction()
