#pragma once

#include <vector>

#include "emulation/canopen/wire_host.h"

namespace interpolated_motion::emulation {

/// The samples of a drive that its interpolator made.
struct Watched {
  std::vector<EposSample> samples;
  explicit Watched(EposDrive& drive) {
    drive.set_sample_observer([this](const EposSample& s) {
      if (s.interpolating) samples.push_back(s);
    });
  }
};

/// A drive whose axis is exactly where the demand is.
inline EposParameters stiff() {
  EposParameters parameters;
  parameters.plant.lag_ms = 0.0;
  return parameters;
}

/// 60 ms from rest to 600 rpm at 10000 rpm/s, 100 ms at 600 rpm, 60 ms to rest: 3200 qc. With 2000 qc per
/// turn 600 rpm are 20 qc/ms and 10000 rpm/s are 1/3 qc/ms^2.
inline void trapezoid(WireHost& host) {
  host.record(600, 600, 60);
  host.record(2600, 600, 100);
  host.record(3200, 0, 60);
}

}  // namespace interpolated_motion::emulation
