# What runs on SocketCAN outside of the stages: tests across the kernel.

# The transports use Boost.Asio: headers, Boost.System, and threads for older C libraries.
function(imd_link_transports)
  find_package(Threads REQUIRED)
  target_include_directories(imd_transport SYSTEM PUBLIC ${Boost_INCLUDE_DIRS})
  target_link_libraries(imd_transport PUBLIC Boost::system Threads::Threads)
endfunction()

# test/socketcan: a GoogleTest program that needs CAN in the kernel and makes interfaces of its own, so it runs within
# scripts/with_vcan.
function(imd_add_socketcan_tests)
  file(GLOB sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/test/socketcan/*.cpp)
  add_executable(socketcan_tests EXCLUDE_FROM_ALL ${sources})
  set_target_properties(socketcan_tests PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR})
  target_include_directories(socketcan_tests PRIVATE ${PROJECT_SOURCE_DIR}/test)
  target_link_libraries(socketcan_tests PRIVATE imd_transport GTest::GTest GTest::Main)
  add_dependencies(tests socketcan_tests)
  set(xml gtest-socketcan_tests.xml)
  catkin_run_tests_target("gtest" socketcan_tests ${xml} DEPENDENCIES socketcan_tests
    COMMAND "${PROJECT_SOURCE_DIR}/scripts/with_vcan --timeout 500 ${PROJECT_BINARY_DIR}/socketcan_tests --gtest_output=xml:${CATKIN_TEST_RESULTS_DIR}/${PROJECT_NAME}/${xml}")
  # They watch the clock.
  set_tests_properties(_ctest_${PROJECT_NAME}_gtest_socketcan_tests PROPERTIES RUN_SERIAL TRUE)
endfunction()
