#include "interpolated_motion_driver/protocol/silverlode/nak.h"

namespace interpolated_motion::silverlode {

std::string_view to_text(NakCode code) {
  switch (code) {
    case NakCode::BadCommand:
      return "bad command";
    case NakCode::DeviceBusy:
      return "device busy";
    case NakCode::Reserved3:
    case NakCode::Reserved4:
      return "reserved";
    case NakCode::BadFormat:
      return "bad format";
    case NakCode::BufferFull:
      return "buffer full";
    case NakCode::BadAddress:
      return "bad address";
    case NakCode::BadResponseRequest:
      return "bad response packet request";
    case NakCode::BadLockoutCode:
      return "bad PUP lockout code";
    case NakCode::BadChecksum:
      return "bad checksum";
  }
  return "unknown code";
}

}  // namespace interpolated_motion::silverlode
