#include "interpolated_motion_driver/axis/cyclic/setpoint_plan.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "interpolated_motion_driver/interpolation/cip_polynomial.h"

namespace interpolated_motion::axis {

namespace {

TailPtr tail_of(const trajectory::Path& path, GoalTime from) {
  auto tail = std::make_unique<SetpointTail>();
  tail->path = path;
  tail->from = from;
  return tail;
}

class GoalEncoder : public TailEncoder {
 public:
  explicit GoalEncoder(encoding::SetpointEncoding encoding) : encoding_(std::move(encoding)) {}

  Expected<TailPtr, Refusal> encode(const trajectory::Path& path) const override {
    const auto certificate = encoding::certify_setpoints(path, encoding_);
    if (!certificate) return certificate.error();
    return tail_of(path, path.start_time());
  }

 private:
  encoding::SetpointEncoding encoding_;
};

class WayOnEncoder : public TailEncoder {
 public:
  WayOnEncoder(encoding::SetpointEncoding encoding, GoalTime from)
      : encoding_(std::move(encoding)), from_(from) {}

  Expected<TailPtr, Refusal> encode(const trajectory::Path& path) const override {
    const GoalTime known = interpolation::kCipHistory * encoding_.period;
    const GoalTime first = std::max(from_ - known, path.start_time());
    const auto certificate = encoding::certify_setpoints_from(first, path, encoding_);
    if (!certificate) return certificate.error();
    return tail_of(path, from_);
  }

 private:
  encoding::SetpointEncoding encoding_;
  GoalTime from_;
};

class StreamEncoder : public TailEncoder {
 public:
  StreamEncoder(encoding::SetpointEncoding encoding, GoalTime from)
      : encoding_(std::move(encoding)), from_(from) {}

  Expected<TailPtr, Refusal> encode(const trajectory::Path& path) const override {
    const double known = std::floor((from_ - path.start_time()) / encoding_.period);
    const double before = std::clamp<double>(known, 0.0, interpolation::kCipHistory);
    const auto certificate =
        encoding::certify_stream_from(from_ - before * encoding_.period, path, encoding_);
    if (!certificate) return certificate.error();
    return tail_of(path, from_);
  }

 private:
  encoding::SetpointEncoding encoding_;
  GoalTime from_;
};

}  // namespace

TailEncoderPtr setpoint_goal_encoder(const encoding::SetpointEncoding& encoding) {
  return std::make_unique<GoalEncoder>(encoding);
}

TailEncoderPtr setpoint_way_on_encoder(const encoding::SetpointEncoding& encoding, GoalTime from) {
  return std::make_unique<WayOnEncoder>(encoding, from);
}

TailEncoderPtr setpoint_stream_encoder(const encoding::SetpointEncoding& encoding, GoalTime from) {
  return std::make_unique<StreamEncoder>(encoding, from);
}

}  // namespace interpolated_motion::axis
