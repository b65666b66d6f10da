#include "studies/run/work_queue.hpp"

#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/partitioner.h>
#include <tbb/task_arena.h>
#include <tbb/task_group.h>

namespace ridgeloc::studies {

namespace {

class ThreadQueue : public WorkQueue {
 public:
  explicit ThreadQueue(int threads)
      : threads_(threads),
        control_(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads)),
        arena_(threads) {}

  std::size_t workers() const override { return static_cast<std::size_t>(threads_); }

  void run(std::uint64_t pieces, const std::atomic<bool>& stop, const Work& work) override {
    std::atomic<std::uint64_t> next{0};
    arena_.execute([&] {
      tbb::task_group_context context;
      // A loop of each worker rather than a task of each piece: those would be begun in no order.
      const auto take_pieces = [&](int) {
        const auto worker = static_cast<std::size_t>(tbb::this_task_arena::current_thread_index());
        while (!stop.load(std::memory_order_relaxed) && !context.is_group_execution_cancelled()) {
          const std::uint64_t piece = next.fetch_add(1, std::memory_order_relaxed);
          if (piece >= pieces) return;
          work(piece, worker);
        }
      };
      tbb::parallel_for(0, threads_, take_pieces, tbb::simple_partitioner{}, context);
    });
  }

 private:
  int threads_;
  tbb::global_control control_;  // the arena sets how many threads there are; this lets them exceed the processors
  tbb::task_arena arena_;
};

}  // namespace

void WorkQueue::run_all(std::uint64_t pieces, const Work& work) {
  const std::atomic<bool> never{false};
  run(pieces, never, work);
}

std::unique_ptr<WorkQueue> thread_queue(int threads) {
  return std::make_unique<ThreadQueue>(threads);
}

}  // namespace ridgeloc::studies
