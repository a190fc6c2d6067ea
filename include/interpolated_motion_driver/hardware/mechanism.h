#pragma once

namespace interpolated_motion::hardware {

/// What is between an encoder and its joint in truth, as the emulated world has it: told apart from the
/// driver's own transmission, so that a wrong one shows.
struct Mechanism {
  double counts_per_unit = 1.0;  ///< counts that the encoder goes on per rad or m of the joint; signed, not 0
  double zero = 0.0;             ///< position of the joint, rad or m, at which the encoder reads 0

  double counts(double position) const { return (position - zero) * counts_per_unit; }  ///< not rounded
  double position(double counts) const { return zero + counts / counts_per_unit; }      ///< rad or m
};

}  // namespace interpolated_motion::hardware
