# src/simulation: the whole driver with emulated drives in virtual time, driven by random histories (docs/simulation.md). A library of
# all but main.cpp, which the tests in test/simulation use too, and the program `simulate` for scripts/simulate.
function(imd_add_simulation)
  set(main ${PROJECT_SOURCE_DIR}/src/simulation/main.cpp)
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/src/simulation/*.cpp)
  list(REMOVE_ITEM sources ${main})
  add_library(imd_simulation STATIC EXCLUDE_FROM_ALL ${sources})
  target_include_directories(imd_simulation PUBLIC ${PROJECT_SOURCE_DIR}/src)
  target_link_libraries(imd_simulation PUBLIC imd_hardware imd_command_line)
  add_executable(simulate EXCLUDE_FROM_ALL ${main})
  set_target_properties(simulate PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR})
  target_link_libraries(simulate PRIVATE imd_simulation)
  set_target_properties(simulate PROPERTIES ENABLE_EXPORTS TRUE) # FailingAllocation reads names of functions
endfunction()

function(imd_add_simulation_tests)
  file(GLOB sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/test/simulation/*_test.cpp)
  imd_add_gtest(simulation_tests "${sources}" imd_simulation)
  set_target_properties(simulation_tests PROPERTIES ENABLE_EXPORTS TRUE)
  add_dependencies(tests simulate)
endfunction()
