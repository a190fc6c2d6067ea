#include "simulation/shrinker.h"

#include <algorithm>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include <yaml-cpp/yaml.h>

#include "interpolated_motion_driver/recording/yaml_text.h"

namespace interpolated_motion::simulation {

namespace {

using Events = std::vector<Event>;

class Shrinker {
 public:
  Shrinker(Script script, const std::function<bool(const Script&)>& fails, int tries)
      : best_(std::move(script)), fails_(fails), tries_(tries) {}

  Script run() {
    drop_events();
    drop_numbers();
    simplify_configuration();
    drop_events();
    return best_;
  }

 private:
  /// Keeps `candidate` if it fails still.
  bool keep(const Script& candidate) {
    if (tries_ <= 0) return false;
    --tries_;
    if (!fails_(candidate)) return false;
    best_ = candidate;
    return true;
  }

  static Events without(const Events& events, std::size_t from, std::size_t count) {
    Events rest = events;
    const auto begin = rest.begin() + static_cast<std::ptrdiff_t>(from);
    rest.erase(begin, begin + static_cast<std::ptrdiff_t>(std::min(count, events.size() - from)));
    return rest;
  }

  /// Leaves out chunks of events, the later ones first, smaller and smaller ones.
  void drop_events() {
    for (std::size_t size = std::max<std::size_t>(1, best_.events.size() / 2); size >= 1; size /= 2) {
      for (std::size_t end = best_.events.size(); end > 0;) {
        const std::size_t from = end > size ? end - size : 0;
        Script candidate = best_;
        candidate.events = without(best_.events, from, end - from);
        keep(candidate);
        end = std::min(from, best_.events.size());
      }
    }
  }

  void drop_numbers() {
    for (std::size_t i = 0; i < best_.events.size(); ++i) {
      const auto numbers = best_.events[i].numbers;
      for (const auto& [name, value] : numbers) {
        Script candidate = best_;
        candidate.events[i].numbers.erase(name);
        keep(candidate);
      }
    }
  }

  void simplify_configuration() {
    drop_joints();
    const YAML::Node yaml = YAML::Load(best_.configuration);
    for (const auto& drive : yaml["drives"]) drop_keys({"drives", drive.first.as<std::string>()});
    for (const auto& bus : yaml["buses"]) drop_keys({"buses", bus.first.as<std::string>()});
    drop_keys({});
  }

  void drop_joints() {
    const auto joints = YAML::Load(best_.configuration)["joints"].as<std::vector<std::string>>();
    for (std::size_t i = joints.size(); i-- > 0;) {
      YAML::Node yaml = YAML::Load(best_.configuration);
      auto rest = yaml["joints"].as<std::vector<std::string>>();
      rest.erase(std::remove(rest.begin(), rest.end(), joints[i]), rest.end());
      yaml["joints"] = rest;
      yaml["drives"].remove(joints[i]);
      keep_configuration(yaml);
    }
  }

  /// Leaves out each key of the map at `path`, and what is left of maps in it, key by key.
  void drop_keys(const std::vector<std::string>& path) {
    std::vector<std::string> keys;
    for (const auto& entry : find(YAML::Load(best_.configuration), path))
      keys.push_back(entry.first.as<std::string>());
    for (const std::string& key : keys) {
      YAML::Node yaml = YAML::Load(best_.configuration);
      const bool is_map = find(yaml, path)[key].IsMap();
      find(yaml, path).remove(key);
      if (keep_configuration(yaml) || !is_map || path.empty()) continue;
      auto deeper = path;
      deeper.push_back(key);
      drop_keys(deeper);
    }
  }

  static YAML::Node find(YAML::Node node, const std::vector<std::string>& path) {
    for (const std::string& key : path) node.reset(node[key]);
    return node;
  }

  bool keep_configuration(const YAML::Node& yaml) {
    Script candidate = best_;
    candidate.configuration = recording::one_line(yaml);
    return keep(candidate);
  }

  Script best_;
  const std::function<bool(const Script&)>& fails_;
  int tries_;
};

}  // namespace

Script shrunk(const Script& script, const std::function<bool(const Script&)>& fails, int tries) {
  return Shrinker(script, fails, tries).run();
}

}  // namespace interpolated_motion::simulation
