#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>

namespace ridgeloc::studies {

/// Hands pieces of work, numbered from 0, to workers. Runner, verification and failure audit know no other way to
/// compute several things at a time.
class WorkQueue {
 public:
  using Work = std::function<void(std::uint64_t piece, std::size_t worker)>;

  WorkQueue() = default;
  WorkQueue(const WorkQueue&) = delete;
  WorkQueue& operator=(const WorkQueue&) = delete;
  virtual ~WorkQueue() = default;

  /// How many pieces may be in work at once. Workers are numbered from 0, and each does one piece at a time.
  virtual std::size_t workers() const = 0;

  /// Calls `work` once for each piece below `pieces`, and returns when all have ended. They are begun in their order,
  /// as workers get free; in which they end is open. Begins no further piece once `stop` is true or a piece has thrown;
  /// what was thrown is thrown again.
  virtual void run(std::uint64_t pieces, const std::atomic<bool>& stop, const Work& work) = 0;

  /// The same, and nothing ends it early.
  void run_all(std::uint64_t pieces, const Work& work);
};

/// The threads of this process; as many as asked for, whatever the number of processors. Precondition: threads > 0.
std::unique_ptr<WorkQueue> thread_queue(int threads);

}  // namespace ridgeloc::studies
