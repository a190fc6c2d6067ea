#include "interpolated_motion_driver/hardware/recorder_configuration.h"

namespace interpolated_motion::hardware {

RecorderConfiguration parse_flight_recorder(ParameterReader reader) {
  RecorderConfiguration recorder;
  recorder.seconds = reader.number("seconds", recorder.seconds, 1.0, 600.0);
  recorder.megabytes = reader.number("megabytes", recorder.megabytes, 0.1, 1024.0);
  recorder.write = reader.choice("write", recorder.write,
                                 {{"on_fault", WriteRecording::OnFault},
                                  {"on_request", WriteRecording::OnRequest},
                                  {"never", WriteRecording::Never}});
  recorder.folder = reader.text("folder", recorder.folder);
  if (recorder.folder.empty())
    reader.fail("folder", "is empty; it must name a folder, \".\" is the present one");
  recorder.keep = static_cast<int>(reader.integer("keep", recorder.keep, 1, 1000));
  reader.refuse_unknown();
  return recorder;
}

}  // namespace interpolated_motion::hardware
