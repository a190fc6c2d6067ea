#pragma once

#include <cstdint>
#include <limits>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <yaml-cpp/yaml.h>

namespace interpolated_motion::hardware {

/// Reads one map of parameters. Every function throws std::invalid_argument whose text names the parameter
/// with its whole path, the value found, and what is allowed.
class ParameterReader {
 public:
  /// `path`: how the map is called in texts, e.g. "drives/joint1". Throws when `node` is neither a map nor
  /// empty.
  ParameterReader(const YAML::Node& node, std::string path);

  /// Whether the key is there; it does not count as known by that.
  bool has(const std::string& key) const;

  /// A number within [`low`, `high`]; `fallback` when the key is missing.
  double number(const std::string& key, double fallback, double low, double high);
  /// As above, but the key must be there.
  double required_number(const std::string& key, double low, double high);
  /// The same for whole numbers, and without a range for the other types.
  std::int64_t integer(const std::string& key, std::int64_t fallback, std::int64_t low, std::int64_t high);
  std::int64_t required_integer(const std::string& key, std::int64_t low, std::int64_t high);
  bool boolean(const std::string& key, bool fallback);
  std::string text(const std::string& key, const std::string& fallback);
  std::string required_text(const std::string& key);
  /// A text that is not empty.
  std::string required_name(const std::string& key);
  /// A list of names, at least one, none twice, none with a slash.
  std::vector<std::string> names(const std::string& key);

  /// One of the words of `choices`; `fallback` when the key is missing.
  template <class Value>
  Value choice(const std::string& key, Value fallback,
               const std::vector<std::pair<std::string, Value>>& choices) {
    known_.insert(key);
    if (!has(key)) return fallback;
    const std::string word = required_text(key);
    std::string allowed;
    for (const auto& [name, value] : choices) {
      if (name == word) return value;
      allowed += (allowed.empty() ? "" : ", ") + name;
    }
    fail(key, "is \"" + word + "\"; allowed: " + allowed);
  }

  /// The map under `key`; an empty one when it is missing.
  ParameterReader map(const std::string& key);
  /// Keys in the order of the file.
  std::vector<std::string> keys() const;
  /// Counts `key` as known without reading it.
  void ignore(const std::string& key) { known_.insert(key); }
  const YAML::Node& node() const { return node_; }

  /// Throws for the first key that nobody has asked for, or that is there twice: a typing error must not pass
  /// as a default.
  void refuse_unknown() const;

  /// Throws "<path>/<key> <what>."
  [[noreturn]] void fail(const std::string& key, const std::string& what) const;

 private:
  YAML::Node required(const std::string& key);

  YAML::Node node_;
  std::string path_;
  std::set<std::string> known_;
};

}  // namespace interpolated_motion::hardware
