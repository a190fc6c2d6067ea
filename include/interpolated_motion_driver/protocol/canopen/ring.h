#pragma once

#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

namespace interpolated_motion::canopen {

/// First-in first-out queue of fixed capacity, allocated once at construction.
template <class T>
class Ring {
 public:
  /// `capacity`: 1 or more.
  explicit Ring(std::size_t capacity) : slots_(capacity) {}

  /// How many values are in it; full at capacity().
  bool empty() const { return size_ == 0; }
  bool full() const { return size_ == slots_.size(); }
  std::size_t size() const { return size_; }
  std::size_t capacity() const { return slots_.size(); }

  /// Appends, or returns false when full.
  bool push(const T& value) {
    if (full()) return false;
    slots_[(first_ + size_) % slots_.size()] = value;
    ++size_;
    return true;
  }

  /// Appends; when full, the oldest makes room. Returns false when one was lost so.
  bool push_over_oldest(const T& value) {
    const bool room = !full();
    if (!room) pop();
    push(value);
    return room;
  }

  /// The oldest. The ring must not be empty.
  const T& front() const { return slots_[first_]; }

  /// Drops the oldest; nothing happens when empty.
  void pop() {
    if (empty()) return;
    first_ = (first_ + 1) % slots_.size();
    --size_;
  }

  /// Takes the oldest out; empty when there is none.
  std::optional<T> take() {
    if (empty()) return std::nullopt;
    std::optional<T> value(std::move(slots_[first_]));
    pop();
    return value;
  }

  /// Drops all; keeps the memory.
  void clear() { first_ = size_ = 0; }

 private:
  std::vector<T> slots_;
  std::size_t first_ = 0;
  std::size_t size_ = 0;
};

}  // namespace interpolated_motion::canopen
