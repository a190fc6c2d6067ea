#include "interpolated_motion_driver/protocol/silverlode/command.h"

namespace interpolated_motion::silverlode {

std::string_view mnemonic(Command command) {
  switch (command) {
    case Command::POL:
      return "POL";
    case Command::CPL:
      return "CPL";
    case Command::HLT:
      return "HLT";
    case Command::STP:
      return "STP";
    case Command::RST:
      return "RST";
    case Command::RVN:
      return "RVN";
    case Command::WRI:
      return "WRI";
    case Command::RRG:
      return "RRG";
    case Command::RIS:
      return "RIS";
    case Command::RIO:
      return "RIO";
    case Command::IMW:
      return "IMW";
    case Command::POR:
      return "POR";
    case Command::MAV:
      return "MAV";
    case Command::ZTP:
      return "ZTP";
    case Command::TTP:
      return "TTP";
    case Command::ERL:
      return "ERL";
    case Command::CIS:
      return "CIS";
    case Command::KMC:
      return "KMC";
    case Command::ADL:
      return "ADL";
    case Command::EMD:
      return "EMD";
    case Command::DMD:
      return "DMD";
    case Command::IMS:
      return "IMS";
    case Command::IMQ:
      return "IMQ";
  }
  return "?";
}

}  // namespace interpolated_motion::silverlode
