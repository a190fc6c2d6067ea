#pragma once

#include <fstream>
#include <map>
#include <string>

namespace interpolated_motion::emulation {

/// Sections of an EDS file (CiA 306): section -> key -> value, all in lower case.
using EdsFile = std::map<std::string, std::map<std::string, std::string>>;

inline std::string lower_case(std::string text) {
  for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

inline EdsFile read_eds(const std::string& path) {
  EdsFile file;
  std::ifstream stream(path);
  std::string section;
  for (std::string line; std::getline(stream, line);) {
    while (!line.empty() && (line.back() == '\r' || line.back() == ' ')) line.pop_back();
    if (line.empty() || line[0] == ';') continue;
    if (line[0] == '[') {
      section = lower_case(line.substr(1, line.find(']') - 1));
      continue;
    }
    const std::size_t equals = line.find('=');
    file[section][lower_case(line.substr(0, equals))] = lower_case(line.substr(equals + 1));
  }
  return file;
}

}  // namespace interpolated_motion::emulation
