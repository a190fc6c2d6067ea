#include "interpolated_motion_driver/recording/recording.h"

#include <algorithm>
#include <cstring>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "interpolated_motion_driver/protocol/canopen/frame.h"
#include "interpolated_motion_driver/protocol/canopen/frame_text.h"
#include "interpolated_motion_driver/recording/byte_ring.h"
#include "interpolated_motion_driver/recording/entry_flags.h"
#include "interpolated_motion_driver/recording/yaml_text.h"

namespace interpolated_motion::recording {

namespace {

/// Reads the bytes of an entry one value after the other.
class Reader {
 public:
  Reader(const std::byte* bytes, std::size_t size) : at_(bytes), end_(bytes + size) {}

  template <class Value>
  Value take() {
    Value value{};
    std::memcpy(&value, at_, sizeof value);
    at_ += sizeof value;
    return value;
  }
  std::vector<double> take_numbers(std::size_t count) {
    std::vector<double> numbers;
    for (std::size_t i = 0; i < count; ++i) numbers.push_back(take<double>());
    return numbers;
  }
  std::string_view rest() const {
    return {reinterpret_cast<const char*>(at_), static_cast<std::size_t>(end_ - at_)};
  }

 private:
  const std::byte* at_;
  const std::byte* end_;
};

std::string name_of(const std::vector<std::string>& names, std::size_t index) {
  return index < names.size() ? names[index] : "?";
}

/// On one line: what does not print as \xNN.
std::string on_one_line(std::string_view text) {
  std::string out;
  for (const char c : text) {
    const bool prints = (c >= ' ' && c <= '~') || (static_cast<unsigned char>(c) & 0x80U) != 0;
    out += prints ? std::string(1, c) : fmt::format("\\x{:02X}", static_cast<unsigned char>(c));
  }
  return out;
}

std::string frame_line(const Subject& subject, const EntryHead& head, Reader bytes) {
  canopen::Frame frame;
  frame.id = bytes.take<std::uint32_t>();
  frame.extended = (head.flags & kExtended) != 0;
  frame.remote = (head.flags & kRemote) != 0;
  frame.length = head.detail;
  const std::string_view data = bytes.rest();
  std::memcpy(frame.data.data(), data.data(), std::min(data.size(), frame.data.size()));
  return fmt::format("wire {} {} {}", name_of(subject.buses, head.source),
                     (head.flags & kOwn) != 0 ? '>' : '<', canopen::to_string(frame));
}

std::string text_line(const Subject& subject, const EntryHead& head, Reader bytes) {
  return fmt::format("wire {} {} {}", name_of(subject.buses, head.source),
                     (head.flags & kOwn) != 0 ? '>' : '<', on_one_line(bytes.rest()));
}

std::string setpoint_line(const Subject& subject, const EntryHead& head, Reader bytes) {
  const std::size_t count = head.detail;
  const auto time = bytes.take<HostTime>();
  std::vector<std::string> joints;
  for (std::size_t i = 0; i < count; ++i)
    joints.push_back(name_of(subject.joints, bytes.take<std::uint8_t>()));
  std::string text = fmt::format("order setpoint {{time: {}, joint_names: {}, positions: {}", time_text(time),
                                 list(joints), list(bytes.take_numbers(count)));
  if ((head.flags & kHasVelocities) != 0) text += ", velocities: " + list(bytes.take_numbers(count));
  const bool refused = (head.flags & kIsRefused) != 0;
  const std::string rest(bytes.rest());
  if (!refused) text += ", source: " + in_quotes(rest);
  return text + fmt::format(", answer: {}}}", refused ? in_quotes("refused: " + rest) : "accepted");
}

std::string joint_line(const Subject& subject, const EntryHead& head, Reader bytes) {
  const auto sample = bytes.take<JointSample>();
  return fmt::format("joint {} {} {} {} {} {} {}", name_of(subject.joints, head.source), sample.desired,
                     sample.desired_velocity, sample.actual, sample.actual_velocity, sample.demand,
                     sample.fill_time);
}

std::string note_line(const EntryHead& head, Reader bytes) {
  const char* word = "log";
  switch (static_cast<NoteKind>(head.detail)) {
    case NoteKind::Group:
      word = "group";
      break;
    case NoteKind::Drive:
      word = "drive";
      break;
    case NoteKind::Bus:
      word = "bus";
      break;
    case NoteKind::End:
      word = "end";
      break;
    case NoteKind::Log:
      break;
  }
  return fmt::format("{} {}", word, on_one_line(bytes.rest()));
}

std::string line_of(const Subject& subject, const EntryHead& head, const std::byte* bytes) {
  const Reader reader(bytes, head.size);
  switch (head.kind) {
    case EntryKind::Frame:
      return frame_line(subject, head, reader);
    case EntryKind::Line:
      return text_line(subject, head, reader);
    case EntryKind::Setpoint:
      return setpoint_line(subject, head, reader);
    case EntryKind::Joint:
      return joint_line(subject, head, reader);
    case EntryKind::Note:
      break;
  }
  return note_line(head, reader);
}

std::string line_of(const Order& order) {
  const std::string goal = order.goal ? ", " + goal_text(*order.goal) : "";
  return fmt::format("order {} {{{}{}}}", order.verb, order.arguments, goal);
}

using Lines = std::vector<std::pair<HostTime, std::string>>;

Lines lines_of(const Recording& recording) {
  Lines lines;
  for (const Order& order : recording.orders) lines.emplace_back(order.time, line_of(order));
  for_each_entry(recording.entries, [&](const EntryHead& head, const std::byte* bytes) {
    lines.emplace_back(head.time, line_of(recording.subject, head, bytes));
  });
  std::stable_sort(lines.begin(), lines.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  return lines;
}

std::string head_of(const Recording& recording, const std::string& cause,
                    std::optional<HostDuration> wall_clock) {
  std::string text = fmt::format(
      "# A recording of interpolated_motion_driver, described in docs/recording.md. Times are the host's "
      "clock, s.\nversion: {}\ncause: {}\nbegin: {}\nend: {}\ncomplete: {}\ndisplaced: {}\norders_left_out: "
      "{}\n",
      kFormatVersion, in_quotes(cause), time_text(recording.begin), time_text(recording.end),
      recording.complete, recording.displaced, recording.orders_left_out);
  if (wall_clock) text += fmt::format("wall_clock: {}\n", time_text(HostTime{*wall_clock}));
  return text + fmt::format("joints: {}\nlimits: {}\nconfiguration: {}\n---\n",
                            list(recording.subject.joints), limits_text(recording.subject.limits),
                            recording.subject.configuration);
}

}  // namespace

std::string to_text(const Recording& recording, const std::string& cause,
                    std::optional<HostDuration> wall_clock) {
  std::string text = head_of(recording, cause, wall_clock);
  for (const auto& [time, line] : lines_of(recording)) {
    text += time_text(time);
    text += ' ';
    text += line;
    text += '\n';
  }
  return text;
}

}  // namespace interpolated_motion::recording
