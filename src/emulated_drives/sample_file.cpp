#include "sample_file.h"

#include <cerrno>
#include <cstring>
#include <stdexcept>

#include <fmt/format.h>

namespace interpolated_motion::emulated_drives {
namespace {

/// Some seconds of a drive's samples: writing takes far longer than computing them.
constexpr std::size_t kBuffer = std::size_t{1} << 20;

}  // namespace

SampleFile::SampleFile(const std::string& folder, const std::string& name) : path_(folder + "/" + name) {
  open();
}

void SampleFile::open() {
  file_.reset(std::fopen(path_.c_str(), "w"));
  if (file_) {
    std::setvbuf(file_.get(), nullptr, _IOFBF, kBuffer);
    return;
  }
  throw std::runtime_error(fmt::format("--samples: {} cannot be written: {}", path_, std::strerror(errno)));
}

void SampleFile::add(const hardware::DemandSample& sample, bool interpolating) {
  const bool begins = interpolating && (!interpolating_ || sample.drive_seconds == 0.0);
  const bool stands = last_ && last_->demand == sample.demand && last_->actual == sample.actual;
  const bool was_interpolating = interpolating_;
  last_ = sample;
  interpolating_ = interpolating;
  if (begins) open();
  if (!interpolating && (!moving_ || stands)) {
    if (moving_) std::fflush(file_.get());
    moving_ = false;
    return;
  }
  moving_ = true;
  fmt::print(file_.get(), "{} {:.6f} {:.6f} {} {}\n", sample.time.time_since_epoch().count(),
             sample.drive_seconds, sample.demand, sample.actual, interpolating ? 1 : 0);
  if (was_interpolating && !interpolating) std::fflush(file_.get());
}

}  // namespace interpolated_motion::emulated_drives
