#pragma once

#include <optional>
#include <string>

namespace interpolated_motion::tools {

/// The driver of a name, that is one process: another one that is started under the same name later is none
/// of whom this client has been asked to move. Asks ROS's master, which may not be there.
class DriverInstance {
 public:
  /// `node`: the name of its node, as a user gives it.
  explicit DriverInstance(const std::string& node);

  /// Whether there is such a node; the first one that is found is the one from then on.
  bool found();
  /// Whether the one that was found is still the one of that name.
  bool is_there() const;

  /// Its full name: "/driver".
  const std::string& node() const { return node_; }

 private:
  std::string node_;
  std::optional<std::string> address_;  ///< of its XML-RPC server, which each process has for itself
};

}  // namespace interpolated_motion::tools
