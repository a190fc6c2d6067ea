#include "interpolated_motion_driver/motion/faults.h"

#include <algorithm>

namespace interpolated_motion::motion {

bool is_out_of_order(const axis::Axis& axis) {
  return axis.state() == axis::AxisState::Fault || axis.state() == axis::AxisState::Offline;
}

bool is_faulted(const axis::Axis& axis) {
  switch (axis.state()) {
    case axis::AxisState::FaultStopping:
    case axis::AxisState::Fault:
    case axis::AxisState::Offline:
      return true;
    default:
      return false;
  }
}

const axis::Axis* find_faulted(const Axes& axes) {
  const auto it = std::find_if(axes.begin(), axes.end(), [](const axis::Axis* a) { return is_faulted(*a); });
  return it == axes.end() ? nullptr : *it;
}

std::string bus_faults(const Signals& signals) {
  std::string text;
  for (const axis::StartSignal* signal : signals) {
    const std::string fault = signal->fault();
    if (!fault.empty()) text += fault + " ";
  }
  return text;
}

std::string fault_text(const Axes& axes, const Signals& signals) {
  std::string text = bus_faults(signals);
  for (const axis::Axis* axis : axes) {
    if (is_faulted(*axis)) text += axis->fault_text() + " ";
  }
  return text + "Remove the cause, call ~reset_faults, then ~enable.";
}

}  // namespace interpolated_motion::motion
