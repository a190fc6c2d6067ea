#include "simulation/known_faults.h"

#include <algorithm>

namespace interpolated_motion::simulation {

namespace {

bool fits(const KnownFault& fault, const Violation& violation) {
  return fault.invariant == violation.invariant &&
         std::all_of(fault.parts.begin(), fault.parts.end(), [&violation](const std::string& part) {
           return violation.sentence.find(part) != std::string::npos;
         });
}

}  // namespace

const std::vector<KnownFault>& known_faults() {
  static const std::vector<KnownFault> faults{
      {"jitter of SYNC is not in a cyclic drive's certificate",
       "on course",
       {"(cyclic)", "off the path"},
       "P14"},
  };
  return faults;
}

const KnownFault* find_known(const Violation& violation) {
  const auto& faults = known_faults();
  const auto found = std::find_if(faults.begin(), faults.end(),
                                  [&violation](const KnownFault& fault) { return fits(fault, violation); });
  return found == faults.end() ? nullptr : &*found;
}

}  // namespace interpolated_motion::simulation
