#pragma once

#include <cstddef>
#include <functional>

namespace interpolated_motion::commissioning {

/// Told how far something is that takes its time: `done` of `all` steps. May be empty.
using Progress = std::function<void(std::size_t done, std::size_t all)>;

}  // namespace interpolated_motion::commissioning
