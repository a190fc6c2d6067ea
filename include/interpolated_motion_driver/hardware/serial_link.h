#pragma once

#include <any>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "interpolated_motion_driver/hardware/bus_link.h"
#include "interpolated_motion_driver/hardware/configuration.h"
#include "interpolated_motion_driver/protocol/silverlode/line_master.h"
#include "interpolated_motion_driver/transport/serial_line.h"

namespace interpolated_motion::hardware {

/// One serial line with its SilverLode master. It has no start signal: its drives are told beforehand when to
/// begin.
class SerialLink : public BusLink {
 public:
  /// `line` must live as long as the link or, if it is that of `device`, as the device.
  SerialLink(const BusConfiguration& configuration, transport::SerialLine& line,
             std::unique_ptr<BusDevice> device = nullptr);

  /// Axes add their devices to it; it lives as long as the link.
  silverlode::LineMaster& master() { return master_; }

  /// What the axes of one kind share on this line: empty until the first one puts it there. It ends before
  /// master() does.
  std::any& shared_by(const DriveKind& kind) { return shared_[&kind]; }
  const std::string& name() const override { return master_.line_name(); }

  void receive(const WireObserver& observer) override;
  void poll(HostTime now) override { master_.poll(now); }
  void signal(HostTime) override {}

  double peak_load() const override { return peak_load_; }
  void reset_peak_load() override { peak_load_ = 0.0; }
  std::uint64_t unexpected() const override;
  std::vector<std::string> unexpected_traffic() const override;

 protected:
  HostTime master_deadline() const override { return master_.next_deadline(); }
  void send_outgoing(HostTime now) override;
  void clear_outgoing() override { master_.clear_outgoing(); }
  void fill_traffic(motion::BusSnapshot& out) const override;

 private:
  void show_sent(const WireObserver& observer);

  transport::SerialLine& line_;
  silverlode::LineMaster master_;
  std::map<const DriveKind*, std::any> shared_;
  std::string received_;  ///< the line being received
  struct Sent {
    std::string text;  ///< without the CR
    HostTime time{};   ///< of its last bit on the line, computed
  };
  std::vector<Sent> sent_;  ///< not yet shown to the observer
  std::uint64_t requests_ = 0;
  std::uint64_t replies_ = 0;
  double peak_load_ = 0.0;
};

}  // namespace interpolated_motion::hardware
