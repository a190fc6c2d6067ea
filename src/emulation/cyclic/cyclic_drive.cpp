#include "interpolated_motion_driver/emulation/cyclic/cyclic_drive.h"

#include <chrono>
#include <utility>

#include "cyclic_drive_implementation.h"
#include "interpolated_motion_driver/emulation/cyclic/motion_watch.h"

namespace interpolated_motion::emulation {
namespace {

constexpr HostDuration kRest = std::chrono::milliseconds(500);

}  // namespace

CyclicDrive::CyclicDrive(transport::VirtualCanBus& bus, const CyclicParameters& parameters, HostTime now)
    : implementation_(std::make_unique<Implementation>(bus, *this, parameters, now)) {
  consist_of(*implementation_);
}

CyclicDrive::~CyclicDrive() = default;

const CyclicParameters& CyclicDrive::parameters() const { return implementation_->parameters(); }

CyclicCounters CyclicDrive::counters() const { return implementation_->counters(); }

void CyclicDrive::observe(Observer observer) {
  if (!observer) return set_sample_observer({});
  const HostDuration servo_period = parameters().servo_period;
  set_sample_observer([observer = std::move(observer), period = seconds(servo_period),
                       watch = MotionWatch(kRest / servo_period)](const CyclicSample& sample) mutable {
    watch.take(sample.following, sample.demand);
    observer({sample.time, period * static_cast<double>(watch.samples()), sample.demand, sample.actual,
              sample.velocity, watch.moving()});
  });
}

void CyclicDrive::set_sample_observer(SampleObserver observer) {
  implementation_->set_sample_observer(std::move(observer));
}

}  // namespace interpolated_motion::emulation
