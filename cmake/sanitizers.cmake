# How the whole build is instrumented, with clang and in a folder of its own (scripts/test --sanitize, scripts/fuzz):
#   IMD_SANITIZE=address  AddressSanitizer and UndefinedBehaviorSanitizer, and what libFuzzer needs to see which code an input reaches: the
#                         fuzzers of test/fuzz and the tests share the libraries
#   IMD_SANITIZE=thread   ThreadSanitizer
# A number that does not fit the integer it is converted to is undefined behaviour, but not among what `undefined` names. The first report
# ends the program.
set(IMD_SANITIZE "" CACHE STRING "Sanitizer of the whole build: address, thread or none")

if(NOT IMD_SANITIZE MATCHES "^(address|thread)?$")
  message(FATAL_ERROR "IMD_SANITIZE is ${IMD_SANITIZE}; it must be address, thread or empty")
endif()
if(IMD_SANITIZE AND NOT CMAKE_CXX_COMPILER_ID STREQUAL Clang)
  message(FATAL_ERROR "IMD_SANITIZE needs clang, not ${CMAKE_CXX_COMPILER}: -DCMAKE_CXX_COMPILER=/usr/bin/clang++-14")
endif()

set(imd_instrumentation "")
if(IMD_SANITIZE STREQUAL address)
  set(imd_instrumentation -fsanitize=address,undefined,float-cast-overflow -fno-sanitize-recover=all -fsanitize=fuzzer-no-link)
elseif(IMD_SANITIZE STREQUAL thread)
  set(imd_instrumentation -fsanitize=thread)
endif()
if(imd_instrumentation)
  # Reports name functions and lines: frame pointers, and debug information for that and no more. _GLIBCXX_ASSERTIONS: an index beyond the
  # end, the value of an empty optional.
  add_compile_options(${imd_instrumentation} -O1 -g1 -fno-omit-frame-pointer)
  add_compile_definitions(_GLIBCXX_ASSERTIONS)
  add_link_options(${imd_instrumentation})
endif()
