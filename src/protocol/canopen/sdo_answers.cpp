#include "interpolated_motion_driver/protocol/canopen/sdo_answers.h"

#include "interpolated_motion_driver/protocol/canopen/object.h"

namespace interpolated_motion::canopen {
namespace {

std::uint32_t object_of(const Frame& frame) { return get_le<std::uint32_t>(frame.data.data()) >> 8; }

unsigned specifier(const Frame& frame) { return frame.data[0] >> 5; }

/// Download, upload: initiate requests. Those of blocks are not counted.
bool begins(const Frame& frame) {
  return frame.length == 8 && (specifier(frame) == 1 || specifier(frame) == 2);
}

/// Upload, download: initiate answers.
bool answers_begin(const Frame& frame) {
  return frame.length == 8 && (specifier(frame) == 2 || specifier(frame) == 3);
}

}  // namespace

void SdoAnswers::on_request(const Frame& frame) {
  if (!begins(frame)) return;
  const std::uint32_t object = object_of(frame);
  if (object != last_[0].object) {
    last_[1] = last_[0];
    last_[0] = {object, 0, 0};
  }
  ++last_[0].requests;
}

void SdoAnswers::on_answer(const Frame& frame) {
  if (!answers_begin(frame)) return;
  for (Exchange& exchange : last_) {
    if (exchange.object != object_of(frame)) continue;
    if (++exchange.answers > exchange.requests) ++surplus_;
    return;
  }
}

}  // namespace interpolated_motion::canopen
