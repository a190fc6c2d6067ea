#include "interpolated_motion_driver/protocol/canopen/sdo_answers.h"

namespace interpolated_motion::canopen {
namespace {

unsigned specifier(const Frame& frame) { return frame.data[0] >> 5; }

/// Download, upload: initiate requests. Those of blocks are not counted.
bool begins(const Frame& frame) {
  return frame.length == 8 && (specifier(frame) == 1 || specifier(frame) == 2);
}

/// Upload, download: initiate answers, and aborts.
bool answers_begin(const Frame& frame) {
  return frame.length == 8 && specifier(frame) >= 2 && specifier(frame) <= 4;
}

}  // namespace

void SdoAnswers::on_request(const Frame& frame) {
  if (begins(frame)) ++open_;
}

void SdoAnswers::on_answer(const Frame& frame) {
  if (!answers_begin(frame)) return;
  if (open_ > 0) {
    --open_;
  } else if (specifier(frame) != 4) {
    ++surplus_;
  }
}

}  // namespace interpolated_motion::canopen
