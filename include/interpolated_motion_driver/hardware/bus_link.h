#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "interpolated_motion_driver/axis/start_signal.h"
#include "interpolated_motion_driver/hardware/bus_device.h"
#include "interpolated_motion_driver/hardware/event_log.h"
#include "interpolated_motion_driver/hardware/wire_observer.h"
#include "interpolated_motion_driver/motion/snapshot.h"
#include "interpolated_motion_driver/units/time.h"

namespace interpolated_motion::hardware {

/// One bus with its master: carries what is sent and received between the master and the transport. A bus
/// outside of the process has a device that may come and go; what the master wanted to send meanwhile is
/// forgotten, because a command of then must not reach a drive now.
class BusLink : public axis::StartSignal {
 public:
  /// As the configuration has it; lives as long as the link.
  virtual const std::string& name() const = 0;

  /// Gives the master everything that has arrived.
  virtual void receive(const WireObserver& observer) = 0;
  /// Follows the device and tells `log` what becomes of it. After receive(), which may find out that it is
  /// gone.
  void follow_device(HostTime now, EventLog& log);
  /// Lets the master do what time demands.
  virtual void poll(HostTime now) = 0;
  /// Hands the transport everything that is due and that it takes.
  void send(HostTime now);
  /// When poll(), send() or follow_device() has something to do by itself; kNever when nothing has.
  HostTime next_deadline() const;

  /// Sets name, traffic and the state of the device ("emulated" without one); leaves what this type of bus
  /// has not.
  void snapshot(motion::BusSnapshot& out) const;
  virtual double peak_load() const = 0;  ///< 0..1, since reset_peak_load()
  /// The next peak begins at 0.
  virtual void reset_peak_load() = 0;
  /// Frames or lines nobody was waiting for, and sentences about them.
  virtual std::uint64_t unexpected() const = 0;
  virtual std::vector<std::string> unexpected_traffic() const = 0;

  std::string fault() const override;

 protected:
  /// `device`: what the bus is reached through; null for a bus inside the process.
  explicit BusLink(std::unique_ptr<BusDevice> device) : device_(std::move(device)) {}

  virtual HostTime master_deadline() const = 0;
  virtual void send_outgoing(HostTime now) = 0;
  virtual void clear_outgoing() = 0;
  virtual void fill_traffic(motion::BusSnapshot& out) const = 0;

 private:
  bool is_down() const { return device_ && !device_->usable(); }
  void note_change(EventLog& log);
  void note_errors(HostTime now, EventLog& log);

  std::unique_ptr<BusDevice> device_;
  bool followed_ = false;
  HostTime next_error_note_{};
  std::uint64_t errors_not_noted_ = 0;
};

}  // namespace interpolated_motion::hardware
