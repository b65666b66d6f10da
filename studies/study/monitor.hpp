#pragma once

#include <atomic>
#include <cstdint>

namespace ridgeloc::studies {

/// What links a block that is being computed to whoever waits for it: whether it should stop, and how far it is. For
/// one thread, but for the two atomics that it refers to, which must outlive it.
class Monitor {
 public:
  Monitor(const std::atomic<bool>& stop, std::atomic<std::uint64_t>& trials_done)
      : stop_(stop), trials_done_(trials_done) {}

  /// Ask once a trial where trials may take a tenth of a second, and otherwise about once a second at least.
  bool stop_requested() const { return stop_.load(std::memory_order_relaxed); }

  /// Counts finished trials of the block, for those who watch.
  void advance(std::uint64_t trials) {
    advanced_ += trials;
    trials_done_.fetch_add(trials, std::memory_order_relaxed);
  }
  std::uint64_t advanced() const { return advanced_; }

 private:
  const std::atomic<bool>& stop_;
  std::atomic<std::uint64_t>& trials_done_;
  std::uint64_t advanced_ = 0;
};

/// A monitor that never asks to stop and that nobody watches.
class NoMonitor : public Monitor {
 public:
  NoMonitor() : Monitor(never(), nobody()) {}

 private:
  static const std::atomic<bool>& never() {
    static const std::atomic<bool> flag{false};
    return flag;
  }
  static std::atomic<std::uint64_t>& nobody() {
    static std::atomic<std::uint64_t> count{0};
    return count;
  }
};

}  // namespace ridgeloc::studies
