#include "studies/run/pilot.hpp"

#include <algorithm>
#include <bit>
#include <chrono>
#include <iterator>
#include <utility>

#include "core/elapsed.hpp"
#include "studies/run/workbench.hpp"
#include "studies/study/audit_sample.hpp"

namespace ridgeloc::studies {

namespace {

/// Of so many cells the pilot keeps blocks.
constexpr std::size_t most_kept_cells = 16;

std::uint64_t predicted(const Study& study, const Plan& plan, std::uint64_t trials,
                        const std::vector<results::Row>& rows) {
  std::vector<results::Statistics> statistics(plan.header.methods.size());
  for (const results::Row& row : rows) statistics[row.method] = row.statistics;
  const Precision precision = precision_of(*study.stop, plan.header, statistics);
  return predicted_trials(*study.stop, precision, trials, plan.header.block_trials);
}

/// Cells in an order in which the first few are spread over all: bit-reversed numbers.
std::vector<std::size_t> spread_order(std::size_t cells) {
  const int bits = static_cast<int>(std::bit_width(cells));
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < std::size_t{1} << bits; ++i) {
    std::size_t reversed = 0;
    for (int bit = 0; bit < bits; ++bit) reversed |= (i >> bit & 1U) << (bits - 1 - bit);
    if (reversed < cells) order.push_back(reversed);
  }
  return order;
}

using Clock = std::chrono::steady_clock;

/// A header that keeps the trials of the first two blocks.
results::Header keeping_header(results::Header header) {
  header.kept_trials = 2 * header.block_trials;
  return header;
}

/// Runs trials of cells and keeps nothing but what they say of the whole.
class PilotRun {
 public:
  PilotRun(const Study& study, const Plan& plan, double budget_s, WorkQueue& queue)
      : study_(study),
        plan_(plan),
        budget_s_(budget_s),
        queue_(queue),
        bench_(study, plan, queue.workers()),
        order_(spread_order(plan.cells.size())),
        keeping_(keeping_header(plan.header)) {}

  Pilot run() {
    const std::uint64_t most =
        std::min(plan_.header.block_trials, study_.stop ? study_.stop->max_trials : study_.trials);
    // A fourth more trials each time: the last round is the longest and so the least disturbed by what happens once.
    run_round(1);
    for (std::uint64_t count = 4; count <= most && !is_over(); count *= 4) run_round(count);
    if (study_.audit > 0.0) run_audited();
    pilot_.seconds_per_cell += preparing_s_;
    return std::move(pilot_);
  }

 private:
  /// What came of a block of one cell.
  struct Piece {
    bool is_done = false;
    double preparing_s = 0.0;
    double seconds = 0.0;
    std::uint64_t predicted_trials = 0;
    std::vector<results::Row> rows;  ///< this and the next of the first cells in order alone
    std::vector<results::TrialColumns> columns;
  };

  bool is_over() const { return core::seconds_since(begin_) >= budget_s_; }

  void run_round(std::uint64_t count) {
    // Of fewer cells than workers some are run several times, so that all workers are in each other's way.
    const std::size_t cells = order_.size();
    std::vector<Piece> pieces(cells * ((queue_.workers() + cells - 1) / cells));
    queue_.run_all(pieces.size(), [&](std::uint64_t piece, std::size_t worker) {
      // A round that is not finished counts only if it is the first.
      if (is_over() && (piece > 0 || count > 1)) return;
      // Of the second block: the first trials of all are audited, which would cost more than the rest.
      run_piece(piece % cells, 1, {plan_.header.block_trials, static_cast<std::size_t>(count)}, worker, pieces[piece]);
    });
    if (count > 1 && !std::ranges::all_of(pieces, &Piece::is_done)) return;
    double seconds = 0.0;
    double preparing_s = 0.0;
    double done = 0.0;
    for (const Piece& piece : pieces) {
      seconds += piece.seconds;
      preparing_s += piece.preparing_s;
      done += piece.is_done ? 1.0 : 0.0;
    }
    const double trials = done * static_cast<double>(count);
    // Later rounds may find the cells prepared.
    preparing_s_ = std::max(preparing_s_, preparing_s / done);
    pilot_.seconds_per_trial = seconds / trials;
    pilot_.trials += static_cast<std::uint64_t>(trials);
    pieces.resize(cells);
    if (study_.stop) predict(pieces);
    keep(std::move(pieces));
  }

  void predict(const std::vector<Piece>& pieces) {
    std::vector<std::uint64_t> predictions(plan_.cells.size());
    for (std::size_t place = 0; place < pieces.size(); ++place)
      predictions[order_[place]] = pieces[place].predicted_trials;
    // What was not run is taken for the longest of those that were.
    const std::uint64_t most = *std::ranges::max_element(predictions);
    std::ranges::replace(predictions, std::uint64_t{0}, most);
    pilot_.predicted_trials = std::move(predictions);
  }

  void keep(std::vector<Piece> pieces) {
    pieces.resize(std::min(pieces.size(), most_kept_cells));
    pilot_.rows.clear();
    pilot_.columns.clear();
    for (Piece& piece : pieces) {
      std::ranges::move(piece.rows, std::back_inserter(pilot_.rows));
      std::ranges::move(piece.columns, std::back_inserter(pilot_.columns));
    }
  }

  void run_audited() {
    const std::uint64_t audited = std::min(study_.trials, always_audited);
    // Of slow trials so many as take about the budget.
    const double affordable = std::clamp(budget_s_ / pilot_.seconds_per_trial, 1.0, static_cast<double>(audited));
    const std::uint64_t count = std::min(static_cast<std::uint64_t>(affordable), plan_.header.block_trials);
    std::vector<Piece> pieces(order_.size());
    const Clock::time_point begin = Clock::now();
    queue_.run_all(pieces.size(), [&](std::uint64_t piece, std::size_t worker) {
      if (piece > 0 && core::seconds_since(begin) >= budget_s_ / 2.0) return;
      run_piece(piece, 0, {0, static_cast<std::size_t>(count)}, worker, pieces[piece]);
    });
    double seconds = 0.0;
    double done = 0.0;
    for (const Piece& piece : pieces) {
      seconds += piece.seconds;
      done += piece.is_done ? 1.0 : 0.0;
    }
    const double more = seconds / done - pilot_.seconds_per_trial * static_cast<double>(count);
    pilot_.seconds_per_cell = std::max(more, 0.0) * static_cast<double>(audited) / static_cast<double>(count);
  }

  void run_piece(std::size_t place, std::uint64_t block, TrialRange range, std::size_t worker, Piece& piece) {
    const std::size_t cell = order_[place];
    const bool is_kept = place < most_kept_cells;
    const Clock::time_point begin = Clock::now();
    const Simulation& simulation = bench_.simulation(worker, cell, study_.methods);
    Workspace& workspace = bench_.workspace(worker);
    piece.preparing_s = core::seconds_since(begin);
    NoMonitor monitor;
    results::BlockSink sink(is_kept ? keeping_ : plan_.header, cell, block, range.count);
    static_cast<void>(simulation.run_block(range, workspace, monitor, sink));
    std::vector<results::Row> rows = sink.take_rows();
    piece.seconds = core::seconds_since(begin) - piece.preparing_s;
    if (study_.stop) piece.predicted_trials = predicted(study_, plan_, range.count, rows);
    if (is_kept) piece.rows = std::move(rows);
    if (is_kept) piece.columns = sink.take_columns();
    piece.is_done = true;
  }

  const Study& study_;
  const Plan& plan_;
  double budget_s_;
  WorkQueue& queue_;
  Workbench bench_;
  std::vector<std::size_t> order_;
  results::Header keeping_;
  Clock::time_point begin_ = Clock::now();
  double preparing_s_ = 0.0;
  Pilot pilot_;
};

}  // namespace

Pilot run_pilot(const Study& study, const Plan& plan, double budget_s, WorkQueue& queue) {
  return PilotRun(study, plan, budget_s, queue).run();
}

}  // namespace ridgeloc::studies
