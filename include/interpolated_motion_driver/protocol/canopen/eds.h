#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "interpolated_motion_driver/protocol/canopen/data_type.h"
#include "interpolated_motion_driver/protocol/canopen/object.h"

namespace interpolated_motion::canopen {

/// By SDO (CiA 306, AccessType); rwr and rww are as rw.
enum class ObjectAccess { ReadOnly, WriteOnly, ReadWrite };

/// What an electronic data sheet says about one object. Empty is what it does not say.
struct EdsObject {
  ObjectAddress address;
  std::string parent;  ///< ParameterName of the array or record it belongs to; empty for a variable
  std::string name;    ///< its own ParameterName
  DataType type = DataType::Unknown;
  ObjectAccess access = ObjectAccess::ReadOnly;
  bool constant = false;                      ///< AccessType is const
  std::optional<std::int64_t> default_value;  ///< `$NODEID+` taken into account
  std::optional<std::int64_t> low;            ///< LowLimit
  std::optional<std::int64_t> high;           ///< HighLimit

  /// "Identity / Vendor ID", "Controlword".
  std::string full_name() const { return parent.empty() ? name : parent + " / " + name; }
};

/// An electronic data sheet (CiA 306): the objects of a kind of drive, by address.
struct Eds {
  std::string product_name;              ///< DeviceInfo, as the others
  std::optional<std::uint32_t> vendor;   ///< VendorNumber
  std::optional<std::uint32_t> product;  ///< ProductNumber
  std::vector<EdsObject> objects;        ///< ascending by address

  /// The object at that address; nullptr where there is none.
  const EdsObject* find(ObjectAddress address) const;
  /// All whose name, or full name, is `name`, whatever their case.
  std::vector<const EdsObject*> find(const std::string& name) const;
};

/// Longest EDS that is read, characters.
inline constexpr std::size_t kLongestEds = 4 << 20;

/// Reads the text of an EDS for node `node` (1..127), which is $NODEID there. Throws std::invalid_argument
/// with the section, key and value that cannot be read.
Eds parse_eds(const std::string& text, std::uint8_t node);

}  // namespace interpolated_motion::canopen
