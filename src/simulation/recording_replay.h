#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "interpolated_motion_driver/recording/recording_file.h"
#include "interpolated_motion_driver/units/time.h"

namespace interpolated_motion::simulation {

/// What came of a recording that was carried out again.
struct Replayed {
  std::optional<recording::RecordedFault> recorded;  ///< the first fault since the first order carried out
  std::optional<recording::RecordedFault> replayed;  ///< on the clock of the recording
  HostDuration poll{0};    ///< longest time between two looks at a drive, and of the replay at its driver
  std::size_t orders = 0;  ///< carried out
  std::size_t answered_otherwise = 0;  ///< of these: accepted then and refused now, or the reverse

  /// The replay has the recording's fault, with the same words and not further than `poll` from its time; or
  /// neither has one.
  bool is_same() const;
};

/// Carries out the orders and injected faults of a recording, with its configuration, by this driver and
/// emulated drives, whatever the buses were. A recording that begins with its driver is repeated from there,
/// at the same times. Another one is repeated from its first order on, which comes 0.1 s after bring-up, with
/// the joints where they were then, and drives disabled if they were: what was injected, or has failed,
/// before that is not known. Each thing that happens is told to `tell`, with its time on the recording's
/// clock. Throws std::invalid_argument where the configuration is not one.
Replayed replay(const recording::RecordingFile& file,
                const std::function<void(HostTime, const std::string&)>& tell = {});

}  // namespace interpolated_motion::simulation
