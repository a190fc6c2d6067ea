#pragma once

#include "interpolated_motion_driver/emulation/silverdust/answer.h"
#include "interpolated_motion_driver/emulation/silverdust/command.h"
#include "interpolated_motion_driver/emulation/silverdust/electronics.h"
#include "interpolated_motion_driver/emulation/silverdust/motion_control.h"
#include "interpolated_motion_driver/emulation/silverdust/packet.h"
#include "interpolated_motion_driver/emulation/silverdust/parameters.h"
#include "interpolated_motion_driver/emulation/silverdust/segment_queue.h"

namespace interpolated_motion::emulation {

/// The commands of "Interpolated Motion" (QCI-TD044): IMS, IMQ, IMW.
class InterpolationCommands {
 public:
  /// Work on what they are given, which must outlive them.
  InterpolationCommands(const SilverDustParameters& parameters, SegmentQueue& queue, MotionControl& motion,
                        const Electronics& electronics)
      : parameters_(parameters), queue_(queue), motion_(motion), electronics_(electronics) {}

  /// Obeys one of them; `packet` has as many parameters as it takes.
  Answer obey(Command command, const Packet& packet);

 private:
  Answer start(const Packet& packet);
  Answer write(const Packet& packet);
  Answer clear();

  const SilverDustParameters& parameters_;
  SegmentQueue& queue_;
  MotionControl& motion_;
  const Electronics& electronics_;
};

}  // namespace interpolated_motion::emulation
