#include "interpolated_motion_driver/transport/virtual_can_bus.h"

#include <algorithm>
#include <deque>
#include <optional>
#include <stdexcept>

#include "interpolated_motion_driver/transport/can_frame_bits.h"
#include "interpolated_motion_driver/transport/stranger.h"

namespace interpolated_motion::transport {
namespace {

constexpr int kHost = 0;
constexpr HostDuration kSecond = std::chrono::seconds(1);
constexpr int kInterframeBits = 3;

HostDuration bit_times(int bits, int bitrate) {
  return HostDuration((static_cast<std::int64_t>(bits) * 1'000'000'000 + bitrate / 2) / bitrate);
}

// Arbitration compares the identifier bit by bit, then RTR; a standard frame wins against an extended one
// whose first 11 bits are the same, because its IDE bit is dominant.
std::uint64_t priority(const canopen::Frame& frame) {
  const std::uint64_t remote = frame.remote ? 1 : 0;
  if (!frame.extended) return (static_cast<std::uint64_t>(frame.id & 0x7FF) << 22) | (remote << 20);
  const std::uint64_t base = (frame.id >> 18) & 0x7FF;
  return (base << 22) | (3ULL << 20) | (static_cast<std::uint64_t>(frame.id & 0x3FFFF) << 1) | remote;
}

}  // namespace

struct VirtualCanBus::Port {
  struct Queued {
    canopen::Frame frame;
    HostTime time{};
    std::uint64_t priority = 0;
  };

  CanListener* listener = nullptr;
  std::size_t capacity = 0;
  bool connected = true;
  std::vector<Queued> ring;
  std::size_t head = 0;
  std::size_t size = 0;

  Port(CanListener* node, std::size_t queue) : listener(node), capacity(queue), ring(queue) {}
  const Queued& front() const { return ring[head]; }
  void push(const canopen::Frame& frame, HostTime time) {
    ring[(head + size) % capacity] = {frame, time, transport::priority(frame)};
    ++size;
  }
  void pop() {
    head = (head + 1) % capacity;
    --size;
  }
};

class VirtualCanBus::HostPort : public CanBus {
 public:
  explicit HostPort(VirtualCanBus& bus) : bus_(bus) {}

  bool send(const canopen::Frame& frame, HostTime now) override {
    if (bus_.faults_.refuse_nth > 0 && --bus_.faults_.refuse_nth == 0) return false;
    if (now < bus_.host_off_until_) return false;
    return bus_.send(kHost, frame, now);
  }

  std::optional<canopen::ReceivedFrame> receive() override {
    if (received_.empty()) return std::nullopt;
    const canopen::ReceivedFrame frame = received_.front();
    received_.pop_front();
    return frame;
  }

  void push(const canopen::Frame& frame, HostTime time, bool own) {
    received_.push_back({frame, time, own});
    ++bus_.delivered_to_host_;
  }

 private:
  VirtualCanBus& bus_;
  std::deque<canopen::ReceivedFrame> received_;
};

VirtualCanBus::VirtualCanBus(std::string name, int bitrate, HostTime start, std::size_t host_queue)
    : name_(std::move(name)),
      bitrate_(bitrate),
      clock_(start),
      free_at_(start),
      host_off_until_(start),
      host_(std::make_unique<HostPort>(*this)),
      second_start_(start) {
  if (bitrate < 10'000 || bitrate > 1'000'000) {
    throw std::invalid_argument("bus " + name_ + ": bitrate " + std::to_string(bitrate) +
                                " bit/s is outside 10000..1000000");
  }
  if (host_queue == 0)
    throw std::invalid_argument("bus " + name_ + ": the host's transmit queue must hold a frame");
  ports_.emplace_back(nullptr, host_queue);
}

VirtualCanBus::~VirtualCanBus() = default;

CanBus& VirtualCanBus::host() { return *host_; }

int VirtualCanBus::add_port(CanListener& listener, std::size_t queue_capacity) {
  ports_.emplace_back(&listener, std::max<std::size_t>(queue_capacity, 1));
  schedule();
  return static_cast<int>(ports_.size()) - 1;
}

Stranger& VirtualCanBus::stranger() {
  if (!stranger_) stranger_ = std::make_unique<Stranger>(*this);
  return *stranger_;
}

bool VirtualCanBus::send(int port, const canopen::Frame& frame, HostTime now) {
  Port& from = ports_[static_cast<std::size_t>(port)];
  const bool down = !from.connected && port != kHost;
  if (down || from.size == from.capacity) return false;
  from.push(frame, std::max(now, clock_));
  if (sender_ < 0 && from.size == 1) schedule();
  return true;
}

std::size_t VirtualCanBus::free_slots(int port) const {
  const Port& from = ports_[static_cast<std::size_t>(port)];
  return from.capacity - from.size;
}

void VirtualCanBus::process(HostTime now) {
  while (next_event_ <= now) {
    clock_ = next_event_;
    if (sender_ >= 0) {
      end_frame();
    } else {
      start_frame(clock_);
    }
    schedule();
  }
  clock_ = std::max(clock_, now);
  account(clock_, 0);
}

void VirtualCanBus::start_frame(HostTime now) {
  sender_ = winner(now);
  if (sender_ < 0) return;
  Port& from = ports_[static_cast<std::size_t>(sender_)];
  current_ = from.front().frame;
  frame_bits_ = can_frame_bits(current_);
  free_at_ = end_at_ = now;
  if (instantaneous_) return;
  free_at_ += bit_times(frame_bits_, bitrate_);
  end_at_ += bit_times(frame_bits_ - kInterframeBits, bitrate_);
}

void VirtualCanBus::end_frame() {
  const canopen::Frame sent = current_;
  Port& from = ports_[static_cast<std::size_t>(sender_)];
  from.pop();
  account(end_at_, frame_bits_);
  ++statistics_.frames;
  if (sender_ == kHost) host_->push(sent, end_at_, true);
  deliver(sent, end_at_);
  sender_ = -1;
}

void VirtualCanBus::deliver(const canopen::Frame& frame, HostTime time) {
  const bool is_nth = faults_.drop_nth > 0 && --faults_.drop_nth == 0;
  const bool dropped = is_nth || faults_.drop > 0 || (faults_.drop_if && faults_.drop_if(frame));
  if (faults_.drop > 0) --faults_.drop;
  if (dropped) {
    ++statistics_.lost;
    return;
  }
  canopen::Frame seen = frame;
  if (faults_.tamper) faults_.tamper(seen);
  const std::size_t ports = ports_.size();
  for (std::size_t i = 0; i < ports; ++i) {
    const Port& port = ports_[i];
    if (static_cast<int>(i) == sender_ || !port.connected) continue;
    if (port.listener != nullptr) {
      port.listener->on_can_frame(seen, time);
    } else if (time >= host_off_until_) {
      host_->push(seen, time, false);
    }
  }
}

bool VirtualCanBus::acknowledged(int sender) const {
  for (std::size_t i = 0; i < ports_.size(); ++i) {
    if (static_cast<int>(i) != sender && ports_[i].connected) return true;
  }
  return false;
}

int VirtualCanBus::winner(HostTime start) const {
  int best = -1;
  std::uint64_t lowest = 0;
  for (std::size_t i = 0; i < ports_.size(); ++i) {
    const Port& port = ports_[i];
    if (port.size == 0 || !port.connected || port.front().time > start) continue;
    if (best >= 0 && port.front().priority >= lowest) continue;
    if (!acknowledged(static_cast<int>(i))) continue;
    best = static_cast<int>(i);
    lowest = port.front().priority;
  }
  return best;
}

HostTime VirtualCanBus::earliest_start() const {
  HostTime earliest = kNever;
  for (std::size_t i = 0; i < ports_.size(); ++i) {
    const Port& port = ports_[i];
    if (port.size == 0 || !port.connected || !acknowledged(static_cast<int>(i))) continue;
    earliest = std::min(earliest, port.front().time);
  }
  return earliest == kNever ? kNever : std::max({earliest, free_at_, clock_});
}

void VirtualCanBus::schedule() { next_event_ = sender_ >= 0 ? end_at_ : earliest_start(); }

void VirtualCanBus::connect(int port, bool connected, HostTime now) {
  Port& changed = ports_[static_cast<std::size_t>(port)];
  clock_ = std::max(clock_, now);
  changed.connected = connected;
  if (!connected && port != kHost) changed.head = changed.size = 0;
  if (!connected && sender_ == port) sender_ = -1;
  schedule();
}

void VirtualCanBus::host_bus_off(HostTime until) {
  host_off_until_ = until;
  Port& host = ports_[kHost];
  host.head = host.size = 0;
  if (sender_ == kHost) sender_ = -1;
  schedule();
}

void VirtualCanBus::account(HostTime end, int bits) {
  while (end - second_start_ >= kSecond) {
    statistics_.load_last_second = std::min(1.0, static_cast<double>(second_busy_) / bitrate_);
    statistics_.load_peak = std::max(statistics_.load_peak, statistics_.load_last_second);
    second_busy_ = 0;
    second_start_ += kSecond;
  }
  statistics_.bits += static_cast<std::uint64_t>(bits);
  second_busy_ += bits;
}

}  // namespace interpolated_motion::transport
