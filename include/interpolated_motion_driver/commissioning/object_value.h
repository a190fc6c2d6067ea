#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "interpolated_motion_driver/protocol/canopen/data_type.h"
#include "interpolated_motion_driver/protocol/canopen/eds.h"
#include "interpolated_motion_driver/protocol/canopen/sdo_result.h"
#include "interpolated_motion_driver/units/expected.h"

namespace interpolated_motion::commissioning {

/// An object of a drive as a user names it, with what is known of it.
struct NamedObject {
  canopen::ObjectAddress address;
  std::string name;  ///< of the EDS, else of CiA 301 and 402; empty where none is known
  canopen::DataType type = canopen::DataType::Unknown;  ///< of the EDS, or of a file of parameters
  const canopen::EdsObject* eds = nullptr;              ///< what the EDS says; nullptr without one
};

/// An object by its number, "0x6064", "0x1018:4", "6064h", or by its name in `eds` (may be nullptr). The
/// error is a sentence: no such number, no such name with the one that may be meant, a name that several
/// have.
Expected<NamedObject, std::string> find_object(const std::string& text, const canopen::Eds* eds);

/// What the value is counted in, as CiA 301 and CiA 402 say; "" where it is a bare number or not known.
std::string unit_of(canopen::ObjectAddress address);

/// "0x6065:00 Max Following Error".
std::string title(const NamedObject& object);

/// A value as a user reads it: "-5", "2000 (0x000007D0)", "\"EPOS2\"". Bytes of an unknown type count as
/// unsigned.
std::string value_text(const canopen::SdoResult& result, canopen::DataType type);
/// The same as it is written to a file and read from it: a bare decimal number, or the text itself.
std::string plain_value(const canopen::SdoResult& result, canopen::DataType type);

/// ", UNSIGNED32, rw, default 2000, range 0..25000 qc", as far as the EDS knows.
std::string facts_text(const NamedObject& object);

/// The bytes of `text` for an object that has `size` bytes (of its type, where that is known). The
/// error is a sentence with the allowed range.
Expected<std::vector<std::uint8_t>, std::string> value_bytes(const std::string& text,
                                                             const NamedObject& object, std::size_t size);

}  // namespace interpolated_motion::commissioning
