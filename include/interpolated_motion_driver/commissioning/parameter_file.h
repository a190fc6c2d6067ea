#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace interpolated_motion::commissioning {

/// One parameter of a drive, as text.
struct Parameter {
  std::string number;  ///< "0x6065:00" of an object, "19" of a register
  std::string type;    ///< "UNSIGNED32", as CiA 301 calls it; a register is an INTEGER32
  std::string value;   ///< decimal
  std::string name;    ///< for the reader; may be empty
};

/// Which drive it is: names and values in a fixed order, such as vendor, product, revision, serial.
using DriveIdentity = std::vector<std::pair<std::string, std::string>>;

/// All parameters of one drive.
struct ParameterFile {
  DriveIdentity identity;
  std::vector<Parameter> parameters;
};

/// First line of such a file.
inline constexpr const char* kParameterFileHeader = "# drive_tool parameters, format 1";
/// More than any drive has; longer files are refused.
inline constexpr std::size_t kMostParameters = 20'000;

/// The file as text: the header, the identity, a line for each parameter.
std::string to_text(const ParameterFile& file);
/// The other way round. Throws std::invalid_argument with the line and what is wrong with it.
ParameterFile parse_parameter_file(const std::string& text);

/// Why parameters of the drive `file` must not be written to the drive `found`, in a sentence; empty when
/// they may. A drive in the place of another (`replacement`) has its own serial number, firmware and address;
/// kind, vendor and product must be the same even so.
std::string why_another_drive(const DriveIdentity& file, const DriveIdentity& found, bool replacement);

}  // namespace interpolated_motion::commissioning
