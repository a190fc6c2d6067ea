#include "interpolated_motion_driver/emulation/epos/epos_drive.h"

#include <utility>

#include "epos_drive_implementation.h"

namespace interpolated_motion::emulation {
namespace {

constexpr double kSample = 1e-3;  // s

DemandSample demand_of(const EposSample& sample) {
  return {sample.time,     kSample * static_cast<double>(sample.samples_since_start),
          sample.demand,   sample.actual,
          sample.velocity, sample.interpolating};
}

}  // namespace

EposDrive::EposDrive(transport::VirtualCanBus& bus, const EposParameters& parameters, HostTime now)
    : implementation_(std::make_unique<Implementation>(bus, *this, parameters, now)) {
  consist_of(*implementation_);
}

EposDrive::~EposDrive() = default;

const EposParameters& EposDrive::parameters() const { return implementation_->parameters(); }

EposCounters EposDrive::counters() const { return implementation_->counters(); }

void EposDrive::observe(Observer observer) {
  if (!observer) return set_sample_observer({});
  set_sample_observer(
      [observer = std::move(observer)](const EposSample& sample) { observer(demand_of(sample)); });
}

void EposDrive::set_sample_observer(SampleObserver observer) {
  implementation_->set_sample_observer(std::move(observer));
}

}  // namespace interpolated_motion::emulation
