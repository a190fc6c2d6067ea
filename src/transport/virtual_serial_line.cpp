#include "interpolated_motion_driver/transport/virtual_serial_line.h"

#include <fmt/format.h>

#include <algorithm>
#include <deque>
#include <optional>
#include <stdexcept>

#include "serial_overlay.h"

namespace interpolated_motion::transport {
namespace {

constexpr std::size_t kInjectors = 2;
constexpr std::size_t kHost = kInjectors;
constexpr std::int64_t kIdleCharacters = 2;
constexpr std::size_t kLongestText = 1024;
constexpr HostDuration kSecond = std::chrono::seconds(1);

std::size_t index(SerialDirection direction) { return direction == SerialDirection::HostToDrive ? 0 : 1; }

template <class Value>
void require(bool valid, const std::string& line, const char* name, const Value& value, const char* range) {
  if (valid) return;
  throw std::invalid_argument(fmt::format("line {}: {} is {}, allowed is {}", line, name, value, range));
}

}  // namespace

struct VirtualSerialLine::Talker {
  struct Queued {
    char value;
    HostTime earliest;
  };

  SerialListener* listener = nullptr;
  SerialDirection direction = SerialDirection::HostToDrive;
  bool connected = true;
  std::deque<Queued> waiting{};
  bool talking = false;
  char value = 0;
  HostTime start{};
  HostTime end{};
  HostTime burst_start{};
  std::int64_t burst_characters = 0;

  HostTime next_start(HostTime now) const {
    return waiting.empty() || talking ? kNever : std::max(waiting.front().earliest, now);
  }

  /// Characters from the one under way on, up to the first CR.
  std::int64_t characters_to_text_end() const {
    if (talking && value == '\r') return 1;
    const auto is_return = [](const Queued& queued) { return queued.value == '\r'; };
    const auto last = std::find_if(waiting.begin(), waiting.end(), is_return);
    const auto characters = last - waiting.begin() + (last == waiting.end() ? 0 : 1);
    return characters + (talking ? 1 : 0);
  }
};

/// What receivers make of a wire: locked on one character until its last bit.
struct VirtualSerialLine::Wire {
  bool locked = false;
  char value = 0;
  HostTime start{};
  HostTime end{};
  SerialDirection direction = SerialDirection::HostToDrive;
  std::uint64_t talkers = 0;  ///< bit per index of a talker in the character
  HostDuration busy{0};       ///< in the second under way
};

class VirtualSerialLine::HostPort : public SerialLine {
 public:
  explicit HostPort(VirtualSerialLine& line) : line_(line) {}

  bool send(std::string_view text, HostTime now) override {
    if (line_.refuse_at_ > 0 && --line_.refuse_at_ == 0) return false;
    Talker& talker = line_.talkers_[kHost];
    const std::size_t capacity = line_.parameters_.host_buffer;
    if (!talker.connected || text.size() > capacity - std::min(capacity, talker.waiting.size())) return false;
    line_.queue(talker, text, now);
    return true;
  }

  std::optional<ReceivedCharacter> receive() override {
    if (received_.empty()) return std::nullopt;
    const ReceivedCharacter character = received_.front();
    received_.pop_front();
    return character;
  }

  void push(const ReceivedCharacter& character) { received_.push_back(character); }

 private:
  VirtualSerialLine& line_;
  std::deque<ReceivedCharacter> received_;
};

VirtualSerialLine::VirtualSerialLine(std::string name, const SerialLineParameters& parameters, HostTime start)
    : name_(std::move(name)),
      parameters_(parameters),
      clock_(start),
      wires_(parameters.wiring == SerialWiring::Rs485TwoWire ? 1 : 2),
      host_(std::make_unique<HostPort>(*this)),
      second_start_(start) {
  const SerialLineParameters& p = parameters_;
  require(p.baud >= 300 && p.baud <= 250'000, name_, "baud", p.baud, "300..250000 bit/s");
  require(p.bits_per_character >= 10 && p.bits_per_character <= 12, name_, "bits_per_character",
          p.bits_per_character, "10..12");
  require(p.host_buffer >= 1, name_, "host_buffer", p.host_buffer, "1 or more characters");
  add_talker(nullptr, SerialDirection::HostToDrive);
  add_talker(nullptr, SerialDirection::DriveToHost);
  add_talker(nullptr, SerialDirection::HostToDrive);
}

VirtualSerialLine::~VirtualSerialLine() = default;

SerialLine& VirtualSerialLine::host() { return *host_; }

void VirtualSerialLine::add_talker(SerialListener* listener, SerialDirection direction) {
  talkers_.emplace_back();
  talkers_.back().listener = listener;
  talkers_.back().direction = direction;
}

int VirtualSerialLine::add_port(SerialListener& listener) {
  const std::size_t port = talkers_.size() - kHost;
  require(port < kMaximumPorts, name_, "number of drives", port, "1..61");
  add_talker(&listener, SerialDirection::DriveToHost);
  return static_cast<int>(port);
}

VirtualSerialLine::Wire& VirtualSerialLine::wire_of(const Talker& talker) {
  return wires_.size() == 1 ? wires_.front() : wires_[index(talker.direction)];
}

HostDuration VirtualSerialLine::duration(std::int64_t characters) const {
  const std::int64_t bits = characters * parameters_.bits_per_character;
  return HostDuration((bits * 1'000'000'000 + parameters_.baud / 2) / parameters_.baud);
}

void VirtualSerialLine::send(int port, std::string_view text, HostTime when) {
  Talker& talker = talkers_[kHost + static_cast<std::size_t>(port)];
  if (talker.connected) queue(talker, text, when);
}

void VirtualSerialLine::inject(SerialDirection direction, std::string_view text, HostTime when) {
  queue(talkers_[index(direction)], text, when);
}

void VirtualSerialLine::queue(Talker& talker, std::string_view text, HostTime when) {
  const HostTime earliest = std::max(when, clock_);
  for (const char value : text) talker.waiting.push_back({value, earliest});
  schedule();
}

HostTime VirtualSerialLine::next_text_end() const {
  HostTime next = host_idle_at_;
  for (const Talker& talker : talkers_) {
    const std::int64_t characters = talker.characters_to_text_end();
    if (characters == 0) continue;
    const HostTime start = talker.talking ? talker.start : talker.next_start(clock_);
    next = std::min(next, start + duration(characters));
  }
  return next;
}

void VirtualSerialLine::process(HostTime now) {
  while (next_event_ <= now) {
    account(next_event_);
    clock_ = next_event_;
    end_characters();
    start_characters();
    if (host_idle_at_ <= clock_) {
      host_idle_at_ = kNever;
      ++host_wakeups_;
    }
    schedule();
  }
  account(now);
  clock_ = std::max(clock_, now);
}

void VirtualSerialLine::end_characters() {
  for (Talker& talker : talkers_) {
    if (talker.talking && talker.end <= clock_) talker.talking = false;
  }
  for (Wire& wire : wires_) {
    if (!wire.locked || wire.end > clock_) continue;
    wire.locked = false;
    wire.busy += wire.end - std::max(wire.start, second_start_);
    deliver(wire);
  }
}

void VirtualSerialLine::start_characters() {
  for (std::size_t i = 0; i < talkers_.size(); ++i) {
    if (talkers_[i].next_start(clock_) <= clock_) start(i);
  }
}

void VirtualSerialLine::start(std::size_t talker_index) {
  Talker& talker = talkers_[talker_index];
  if (talker.end != clock_ || talker.burst_characters == 0) {
    talker.burst_start = clock_;
    talker.burst_characters = 0;
  }
  talker.talking = true;
  talker.value = talker.waiting.front().value;
  talker.waiting.pop_front();
  talker.start = clock_;
  talker.end = talker.burst_start + duration(++talker.burst_characters);
  ++statistics_.characters;

  const auto bits_after = [&](HostTime time, HostTime reference) {
    return (2 * (time - reference).count() * parameters_.baud + 1'000'000'000) / 2'000'000'000;
  };
  Wire& wire = wire_of(talker);
  const std::uint64_t self = std::uint64_t{1} << talker_index;
  if (wire.locked) {
    wire.value = overlay(wire.value, talker.value, bits_after(talker.start, wire.start));
    wire.talkers |= self;
    ++statistics_.collisions;
    return;
  }
  wire.locked = true;
  wire.value = talker.value;
  wire.start = talker.start;
  wire.end = talker.end;
  wire.direction = talker.direction;
  wire.talkers = self;
  for (std::size_t i = 0; i < talkers_.size(); ++i) {
    const Talker& other = talkers_[i];
    if (i == talker_index || !other.talking || &wire_of(other) != &wire) continue;
    wire.value = overlay(wire.value, other.value, -bits_after(talker.start, other.start));
    wire.talkers |= std::uint64_t{1} << i;
    ++statistics_.collisions;
  }
}

void VirtualSerialLine::deliver(const Wire& wire) {
  char value = wire.value;
  if (!apply_fault(wire.direction, value)) return;
  record(wire.direction, value);
  const bool two_wire = wires_.size() == 1;
  const std::size_t talkers = talkers_.size();
  for (std::size_t i = kHost; i < talkers; ++i) {
    const Talker& receiver = talkers_[i];
    const bool own = (wire.talkers >> i & 1U) != 0;
    if (!receiver.connected || (own && !(i == kHost && parameters_.echo))) continue;
    if (!two_wire && !own && receiver.direction == wire.direction) continue;
    if (i == kHost) {
      deliver_to_host(value);
    } else {
      receiver.listener->on_character(value, wire.end);
    }
  }
}

void VirtualSerialLine::deliver_to_host(char value) {
  host_->push({value, clock_});
  ++delivered_to_host_;
  if (value == '\r') {
    ++host_wakeups_;
    host_idle_at_ = kNever;
  } else {
    host_idle_at_ = clock_ + duration(kIdleCharacters);
  }
}

bool VirtualSerialLine::apply_fault(SerialDirection direction, char& value) {
  Fault& fault = faults_[index(direction)];
  const bool in_lost_text = fault.lose_text == 1;
  if (fault.lose_text > 0 && value == '\r') --fault.lose_text;
  if (in_lost_text) {
    ++statistics_.lost;
    return false;
  }
  if (fault.lose > 0) {
    --fault.lose;
    ++statistics_.lost;
    return false;
  }
  if (fault.garble > 0) {
    --fault.garble;
    value = static_cast<char>(static_cast<unsigned char>(value) ^ fault.mask);
  }
  return true;
}

void VirtualSerialLine::record(SerialDirection direction, char value) {
  if (!observer_) return;
  std::string& text = texts_[index(direction)];
  if (value == '\r') {
    observer_(direction, text, clock_);
    text.clear();
  } else if (value != '\n' && text.size() < kLongestText) {
    text.push_back(value);
  }
}

void VirtualSerialLine::lose_next(SerialDirection direction, int count) {
  faults_[index(direction)].lose = count;
}

void VirtualSerialLine::lose_text(SerialDirection direction, int n) {
  faults_[index(direction)].lose_text = n;
}

void VirtualSerialLine::garble_next(SerialDirection direction, int count, unsigned char mask) {
  faults_[index(direction)].garble = count;
  faults_[index(direction)].mask = mask;
}

void VirtualSerialLine::connect(int port, bool connected, HostTime now) {
  Talker& changed = talkers_[kHost + static_cast<std::size_t>(port)];
  account(now);
  clock_ = std::max(clock_, now);
  changed.connected = connected;
  if (!connected) changed.waiting.clear();
  schedule();
}

void VirtualSerialLine::account(HostTime until) {
  while (until - second_start_ >= kSecond) {
    const HostTime second_end = second_start_ + kSecond;
    HostDuration busiest{0};
    for (Wire& wire : wires_) {
      if (wire.locked && wire.start < second_end) {
        wire.busy += std::min(wire.end, second_end) - std::max(wire.start, second_start_);
      }
      busiest = std::max(busiest, wire.busy);
      wire.busy = HostDuration(0);
    }
    statistics_.load_last_second = seconds(busiest);
    statistics_.load_peak = std::max(statistics_.load_peak, statistics_.load_last_second);
    second_start_ = second_end;
  }
}

void VirtualSerialLine::schedule() {
  HostTime next = host_idle_at_;
  for (const Talker& talker : talkers_) {
    next = std::min(next, talker.talking ? talker.end : talker.next_start(clock_));
  }
  next_event_ = next;
}

}  // namespace interpolated_motion::transport
