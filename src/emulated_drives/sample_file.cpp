#include "sample_file.h"

#include <cstdio>
#include <stdexcept>

#include <fmt/format.h>

namespace interpolated_motion::emulated_drives {
namespace {

/// Some seconds of a drive's samples: writing takes far longer than computing them.
constexpr std::size_t kBuffer = std::size_t{1} << 20;

bool is_sample(const std::string& line) {
  long long time = 0;
  double seconds = 0.0;
  double demand = 0.0;
  int actual = 0;
  int interpolating = 0;
  int length = 0;
  return std::sscanf(line.c_str(), "%lld %lf %lf %d %d%n", &time, &seconds, &demand, &actual, &interpolating,
                     &length) == 5 &&
         static_cast<std::size_t>(length) == line.size();
}

command_line::OpenFile open_samples(const std::string& path) {
  try {
    return command_line::open_output_file(path, command_line::EarlierFile::Replace, &is_sample);
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(fmt::format("--samples: {}", error.what()));
  }
}

}  // namespace

SampleFile::SampleFile(const std::string& folder, const std::string& name)
    : path_(folder + "/" + name), file_(open_samples(path_)) {
  std::setvbuf(file_.get(), nullptr, _IOFBF, kBuffer);
}

void SampleFile::add(const emulation::DemandSample& sample) {
  const bool interpolated = last_ && last_->interpolating;
  const bool rests = last_ && last_->demand == sample.demand;
  const bool stands = rests && last_->actual == sample.actual;
  last_ = sample;
  if (sample.interpolating && (!interpolated || sample.drive_seconds == 0.0))
    command_line::begin_anew(file_.get(), path_);
  if (!sample.interpolating && (!moving_ || stands)) {
    if (moving_) std::fflush(file_.get());
    moving_ = false;
    return;
  }
  moving_ = true;
  fmt::print(file_.get(), "{} {:.6f} {:.6f} {} {}\n", sample.time.time_since_epoch().count(),
             sample.drive_seconds, sample.demand, sample.actual, sample.interpolating ? 1 : 0);
  const bool ends = interpolated && !sample.interpolating;
  if (ends || (rests && !rested_)) std::fflush(file_.get());
  rested_ = rests;
}

}  // namespace interpolated_motion::emulated_drives
