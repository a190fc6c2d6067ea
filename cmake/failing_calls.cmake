# Lets system calls of a test program fail: test/failing_calls/failing_calls.h. The list is that of failing_calls().
function(imd_let_calls_fail target)
  target_sources(${target} PRIVATE ${PROJECT_SOURCE_DIR}/test/failing_calls/failing_calls.cpp)
  foreach(call open read write ioctl flock isatty epoll_ctl socket bind setsockopt recvmmsg send recv)
    target_link_options(${target} PRIVATE "LINKER:--wrap=${call}")
  endforeach()
endfunction()
