#pragma once

#include <string>
#include <vector>

namespace interpolated_motion::test {

/// System calls that can be made to fail: those that the transports use. A program that has them is linked
/// with --wrap for each (cmake/failing_calls.cmake).
const std::vector<std::string>& failing_calls();

/// While it lives, the `n`-th call of `call` (1: the next one) fails with `error` and does nothing.
class FailingCall {
 public:
  FailingCall(const std::string& call, int n, int error);
  ~FailingCall();
  FailingCall(const FailingCall&) = delete;
  FailingCall& operator=(const FailingCall&) = delete;

  /// The call has failed.
  bool has_happened() const;
};

/// Calls count only within such a scope: what a test does besides goes on undisturbed.
class Counted {
 public:
  Counted();
  ~Counted();
  Counted(const Counted&) = delete;
  Counted& operator=(const Counted&) = delete;
};

/// Descriptors that this process has open.
int open_descriptors();

}  // namespace interpolated_motion::test
