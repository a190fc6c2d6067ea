#include "interpolated_motion_driver/commissioning/parameter_file.h"

#include <algorithm>
#include <array>
#include <sstream>
#include <stdexcept>

#include <fmt/format.h>

#include "interpolated_motion_driver/protocol/canopen/data_type.h"

namespace interpolated_motion::commissioning {
namespace {

/// What a drive that takes the place of another one need not have from it.
constexpr std::array<const char*, 3> kOfTheUnit{"revision", "serial", "address"};

std::string without_comment(const std::string& line) {
  std::string text = line.substr(0, line.find('#'));
  while (!text.empty() && (text.back() == ' ' || text.back() == '\r' || text.back() == '\t')) text.pop_back();
  return text;
}

[[noreturn]] void refuse(int line, const std::string& text, const char* reason) {
  throw std::invalid_argument(fmt::format("line {} is \"{}\": {}", line, text, reason));
}

bool is_number(const std::string& text) {
  const std::size_t first = text[0] == '-' ? 1 : 0;
  return text.size() > first && text.find_first_not_of("0123456789", first) == std::string::npos;
}

Parameter parse_parameter(int number, const std::string& line) {
  std::istringstream words(without_comment(line));
  Parameter parameter;
  std::string more;
  if (!(words >> parameter.number >> parameter.type >> parameter.value) || words >> more)
    refuse(number, line, "a parameter is NUMBER TYPE VALUE, such as 0x6065:00 UNSIGNED32 2000");
  if (!is_number(parameter.value) || canopen::size_of(canopen::data_type(parameter.type)) == 0)
    refuse(number, line, "TYPE is such as UNSIGNED32 or INTEGER16, and VALUE a decimal number");
  const std::size_t comment = line.find("# ");
  if (comment != std::string::npos) parameter.name = line.substr(comment + 2);
  return parameter;
}

bool of_the_unit(const std::string& name) {
  return std::find(kOfTheUnit.begin(), kOfTheUnit.end(), name) != kOfTheUnit.end();
}

std::string value_of(const DriveIdentity& identity, const std::string& name) {
  const auto found = std::find_if(identity.begin(), identity.end(),
                                  [&name](const auto& entry) { return entry.first == name; });
  return found == identity.end() ? "" : found->second;
}

}  // namespace

std::string to_text(const ParameterFile& file) {
  std::string text = std::string(kParameterFileHeader) + "\n";
  for (const auto& [name, value] : file.identity) text += fmt::format("{}: {}\n", name, value);
  for (const Parameter& parameter : file.parameters) {
    std::string line = fmt::format("{:<10} {:<11} {}", parameter.number, parameter.type, parameter.value);
    if (!parameter.name.empty()) line = fmt::format("{:<34} # {}", line, parameter.name);
    text += line + "\n";
  }
  return text;
}

ParameterFile parse_parameter_file(const std::string& text) {
  std::istringstream stream(text);
  ParameterFile file;
  int number = 0;
  for (std::string line; std::getline(stream, line);) {
    if (++number == 1 && without_comment(line).empty() && line.rfind(kParameterFileHeader, 0) == 0) continue;
    if (number == 1)
      refuse(1, line,
             "no file of drive_tool dump, whose first line is \"# drive_tool parameters, format 1\"");
    const std::string content = without_comment(line);
    if (content.empty()) continue;
    const std::size_t colon = content.find(": ");
    if (colon != std::string::npos) {
      file.identity.emplace_back(content.substr(0, colon), content.substr(colon + 2));
      continue;
    }
    if (file.parameters.size() >= kMostParameters)
      refuse(number, line, "there are more than 20000 parameters");
    file.parameters.push_back(parse_parameter(number, line));
  }
  if (file.identity.empty() || file.parameters.empty())
    throw std::invalid_argument("it names no drive, or has no parameters; it has been cut off");
  return file;
}

std::string why_another_drive(const DriveIdentity& file, const DriveIdentity& found, bool replacement) {
  bool of_unit_only = true;
  std::string differences;
  for (const auto& [name, value] : found) {
    const std::string wanted = value_of(file, name);
    if (wanted == value || (replacement && of_the_unit(name))) continue;
    of_unit_only = of_unit_only && of_the_unit(name);
    differences += fmt::format("{}{} is {} in the file and {} in the drive", differences.empty() ? "" : ", ",
                               name, wanted.empty() ? "not told" : wanted, value);
  }
  if (differences.empty()) return "";
  return fmt::format("the file is of another drive: {}{}", differences,
                     of_unit_only ? ". Where this drive takes the place of that one: --replacement" : "");
}

}  // namespace interpolated_motion::commissioning
