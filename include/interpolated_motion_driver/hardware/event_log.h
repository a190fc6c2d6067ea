#pragma once

#include <deque>
#include <functional>
#include <optional>
#include <string>
#include <utility>

namespace interpolated_motion::hardware {

/// As rosconsole's levels. Error: something does not work until it is seen to.
enum class Severity { Debug, Info, Warning, Error };

/// One sentence for the log.
struct LogEntry {
  Severity severity = Severity::Info;  ///< how the node logs it
  std::string text;                    ///< names the bus, joint or parameter it is about
};

/// Sentences waiting to be taken by whoever logs. When nobody does, the oldest are forgotten.
class EventLog {
 public:
  /// When 1000 wait, the oldest is forgotten.
  void add(Severity severity, std::string text) {
    if (entries_.size() == kCapacity) entries_.pop_front();
    entries_.push_back({severity, std::move(text)});
    if (observer_) observer_(entries_.back());
  }

  /// `observer` is told of each sentence at once.
  void set_observer(std::function<void(const LogEntry&)> observer) { observer_ = std::move(observer); }

  /// The oldest; empty when none waits.
  std::optional<LogEntry> take() {
    if (entries_.empty()) return std::nullopt;
    LogEntry entry = std::move(entries_.front());
    entries_.pop_front();
    return entry;
  }

 private:
  static constexpr std::size_t kCapacity = 1000;
  std::deque<LogEntry> entries_;
  std::function<void(const LogEntry&)> observer_;
};

}  // namespace interpolated_motion::hardware
