#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "interpolated_motion_driver/transport/serial_line.h"
#include "interpolated_motion_driver/units/time.h"

namespace interpolated_motion::transport {

/// Who talks; on a two-wire line the other drives hear that too.
enum class SerialDirection { HostToDrive, DriveToHost };

/// How host and drives are connected.
enum class SerialWiring {
  Rs485TwoWire,    ///< one pair for both directions: everybody hears everybody, any two talkers collide
  Rs232MultiDrop,  ///< one wire a direction: the drives hear the host only, the host hears all drives, and
                   ///< only drives collide
};

/// What a virtual serial line is.
struct SerialLineParameters {
  int baud = 57'600;            ///< bit/s, 300..250000
  int bits_per_character = 11;  ///< start, data and stop bits: 8N2 has 11, 8N1 has 10; 10..12
  SerialWiring wiring = SerialWiring::Rs485TwoWire;  ///< decides who hears whom, and whose characters collide
  bool echo = false;                ///< the host hears its own characters, as through an RS-485 adapter that
                                    ///< does not switch its receiver off
  std::size_t host_buffer = 4'096;  ///< characters, 1 or more: the host's transmit buffer
};

/// A node on a virtual serial line; told about each character it hears.
class SerialListener {
 public:
  virtual ~SerialListener() = default;

  /// `time` is that of the character's last bit. May send, but not process the line.
  virtual void on_character(char value, HostTime time) = 0;
};

/// What has been on a virtual serial line since it was made.
struct SerialLineStatistics {
  std::uint64_t characters = 0;   ///< sent by all talkers, injected ones included
  std::uint64_t collisions = 0;   ///< characters spoilt because somebody else was talking
  std::uint64_t lost = 0;         ///< characters taken away by an injection
  double load_last_second = 0.0;  ///< 0..1, in the last full second; of the busier wire if there are two
  double load_peak = 0.0;         ///< 0..1, in the busiest full second
};

/// An asynchronous serial line inside the process, with the time real characters take on it: each talker
/// sends its characters back to back, `bits_per_character` bit times each, without a rounding that adds up;
/// all others on the wire receive a character at its last bit. Port 0 is the host.
///
/// When two talk at once the line is low whenever one of them drives it low. A receiver locks on the start
/// bit that comes first and samples there; the other's character reaches nobody. So two drives that answer
/// with the same text at the same instant go unnoticed, as on a real line, and everything else is garbage.
class VirtualSerialLine {
 public:
  using TextObserver = std::function<void(SerialDirection, std::string_view text, HostTime time)>;

  static constexpr int kMaximumPorts = 62;  ///< host included

  /// Throws std::invalid_argument naming line, parameter, value and range when a parameter is wrong. `start`
  /// is the time of the idle line.
  VirtualSerialLine(std::string name, const SerialLineParameters& parameters, HostTime start = HostTime{});
  ~VirtualSerialLine();
  VirtualSerialLine(const VirtualSerialLine&) = delete;
  VirtualSerialLine& operator=(const VirtualSerialLine&) = delete;

  /// As given to the constructor.
  const std::string& name() const { return name_; }
  const SerialLineParameters& parameters() const { return parameters_; }

  /// The host's end of the line. Characters can be read there from their last bit on.
  SerialLine& host();

  /// A further node, connected at once; returns its port number (1, 2, ...). `listener` must outlive the line
  /// or be disconnected before. Throws std::invalid_argument when there are kMaximumPorts already.
  int add_port(SerialListener& listener);

  /// Sends `text` from a port as soon as the port has sent what it was given before, but not before `when`,
  /// which may lie in the future. Nothing happens when the port is disconnected.
  void send(int port, std::string_view text, HostTime when);

  /// Time of `characters` characters sent back to back.
  HostDuration duration(std::int64_t characters) const;

  /// Time of the next change on the line (a character starts or ends, a wake-up of the host is due), kNever
  /// when there is nothing to come.
  HostTime next_event() const { return next_event_; }

  /// Runs the line up to and including `now`: starts, ends and delivers characters.
  void process(HostTime now);

  /// Characters delivered to the host so far, whether read or not.
  std::uint64_t delivered_to_host() const { return delivered_to_host_; }

  /// Number of times the host had a reason to read: a CR arrived, or the line went idle for two characters
  /// after others. A scheduler that wakes its host whenever this grows never wakes it for each character.
  std::uint64_t host_wakeups() const { return host_wakeups_; }

  /// When somebody is to be woken who serves whole texts only: the earliest end of a text under way or
  /// waiting, up to its CR, in either direction, or of the silence after one without; kNever when there is
  /// none. Of several texts that wait for each other only the first counts.
  HostTime next_text_end() const;

  /// Figures up to the last call of process().
  const SerialLineStatistics& statistics() const { return statistics_; }

  /// Called at the CR of each line, with the text as the receivers of that direction got it, CR and LF not
  /// included. An empty function ends that.
  void set_text_observer(TextObserver observer) { observer_ = std::move(observer); }

  /// The next `count` characters of a direction reach nobody but still take their time.
  void lose_next(SerialDirection direction, int count);

  /// The `n`-th text of a direction from now on, up to its CR, reaches nobody; 0: none. A text under way
  /// counts.
  void lose_text(SerialDirection direction, int n);

  /// The host's `n`-th send() from now on fails, as it does when its buffer is full; 0: none.
  void refuse_nth(int n) { refuse_at_ = n; }

  /// The bits of `mask` are inverted in the next `count` characters of a direction.
  void garble_next(SerialDirection direction, int count, unsigned char mask = 0x55);

  /// Characters nobody on the line has sent appear on it at `when`; in two-wire operation all hear them.
  void inject(SerialDirection direction, std::string_view text, HostTime when);

  /// Plugs a port in or out (port 0: the host). A port that is out hears nothing and has lost what it had
  /// not sent yet; the host's send() refuses text meanwhile.
  void connect(int port, bool connected, HostTime now);

 private:
  struct Talker;
  struct Wire;
  class HostPort;

  struct Fault {
    int lose = 0;            ///< characters still to be taken away, see lose_next()
    int lose_text = 0;       ///< which text from now on is taken away, 1: the next; 0: none
    int garble = 0;          ///< characters still to be spoilt, see garble_next()
    unsigned char mask = 0;  ///< bits that are inverted in those
  };

  Wire& wire_of(const Talker& talker);
  void add_talker(SerialListener* listener, SerialDirection direction);
  void queue(Talker& talker, std::string_view text, HostTime when);
  void start_characters();
  void end_characters();
  void start(std::size_t index);
  void deliver(const Wire& wire);
  void deliver_to_host(char value);
  bool apply_fault(SerialDirection direction, char& value);
  void record(SerialDirection direction, char value);
  void account(HostTime until);
  void schedule();

  std::string name_;
  SerialLineParameters parameters_;
  HostTime clock_;
  HostTime next_event_ = kNever;
  HostTime host_idle_at_ = kNever;
  std::vector<Talker> talkers_;  ///< two injectors, one a direction, then the ports
  std::vector<Wire> wires_;
  std::unique_ptr<HostPort> host_;
  std::uint64_t delivered_to_host_ = 0;
  std::uint64_t host_wakeups_ = 0;
  std::array<Fault, 2> faults_;
  int refuse_at_ = 0;
  std::array<std::string, 2> texts_;
  TextObserver observer_;
  SerialLineStatistics statistics_;
  HostTime second_start_;
};

}  // namespace interpolated_motion::transport
