#pragma once

#include <algorithm>

#include "interpolated_motion_driver/axis/axis_parameters.h"
#include "interpolated_motion_driver/axis/cia402/cia402_parameters.h"
#include "interpolated_motion_driver/hardware/can_link.h"
#include "interpolated_motion_driver/hardware/configuration.h"
#include "interpolated_motion_driver/hardware/parameter_reader.h"

/// Parameters that several kinds of drives take from a configuration alike.
namespace interpolated_motion::hardware {

/// Those of every axis.
void set_axis_parameters(axis::AxisParameters& parameters, const DriveConfiguration& drive,
                         const Configuration& all);

/// Those of every axis of a CiA 402 drive, the former included.
void set_cia402_parameters(axis::Cia402AxisParameters& parameters, const DriveConfiguration& drive,
                           const Configuration& all, const CanLink& link);

/// Those of an axis that encodes records and keeps them in its drive, besides its stream_deviation_bound.
template <class Parameters>
void set_record_parameters(Parameters& parameters, const DriveConfiguration& drive,
                           const Configuration& all) {
  parameters.deviation_bound = drive.deviation_bound;
  parameters.limit_margin = drive.limit_margin;
  parameters.commit_horizon = all.commit_horizon;
  parameters.stream_horizon = all.setpoints.horizon.count();
}

/// Reads `stream_deviation_bound`, counts: the drive's deviation_bound where the path is still being made.
/// `fallback`: where it is not given; never less than deviation_bound.
inline double parse_stream_deviation_bound(ParameterReader& reader, const DriveConfiguration& drive,
                                           double fallback) {
  return reader.number("stream_deviation_bound", std::max(fallback, drive.deviation_bound),
                       drive.deviation_bound, 1e6);
}

}  // namespace interpolated_motion::hardware
