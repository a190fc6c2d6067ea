#pragma once

#include <cstdint>

namespace interpolated_motion::emulation {

/// SDO abort codes the emulated drive uses (CiA 301, table of abort codes; the last one is maxon's).
enum class AbortCode : std::uint32_t {
  None = 0,
  ToggleBit = 0x05030000,
  CommandSpecifier = 0x05040001,
  BlockSize = 0x05040002,
  SequenceNumber = 0x05040003,
  Crc = 0x05040004,
  UnsupportedAccess = 0x06010000,
  WriteOnly = 0x06010001,
  ReadOnly = 0x06010002,
  NoSuchObject = 0x06020000,
  NotMappable = 0x06040041,
  PdoLength = 0x06040042,
  Incompatible = 0x06040043,
  LengthMismatch = 0x06070010,
  TooLong = 0x06070012,
  TooShort = 0x06070013,
  NoSuchSubindex = 0x06090011,
  ValueRange = 0x06090030,
  ValueTooHigh = 0x06090031,
  ValueTooLow = 0x06090032,
  CannotStore = 0x08000020,
  DeviceState = 0x08000022,
  WrongNmtState = 0x0F00FFC0,
};

}  // namespace interpolated_motion::emulation
