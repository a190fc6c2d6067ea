#pragma once

#include <boost/outcome/result.hpp>

namespace interpolated_motion {

/// Either a value or the reason why there is none: `if (!r) return r.error();`, `r.value()`.
/// Returned where the caller must handle the failure; nothing on the streaming path throws.
template <class Value, class Error>
using Expected = boost::outcome_v2::basic_result<Value, Error, boost::outcome_v2::policy::terminate>;

}  // namespace interpolated_motion
