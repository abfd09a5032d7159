// SPDX-License-Identifier: MIT
#include "cuda/cuda_backend.h"

#include <limits>
#include <optional>

#include <fmt/format.h>

#include "core/check_world.h"
#include "core/error.h"
#include "core/flake_words.h"
#include "core/snapshot.h"
#include "core/state_hash.h"
#include "core/world_hash.h"
#include "cuda/captured_graph.h"
#include "cuda/device.h"
#include "cuda/device_world.h"
#include "cuda/draw_sort.h"
#include "cuda/flake_sums.h"
#include "cuda/late_control.h"
#include "cuda/rearrange.h"
#include "cuda/stage_clock.h"
#include "cuda/step_kernels.h"
#include "cuda/visible_list.h"

namespace spindrift::gpu
{

namespace
{

class CudaBackend final : public Backend
{
  public:
    CudaBackend(const World& world, FlakeMemory& memory, const CudaOptions& options)
        : options_(options),
          capacity_(world.capacity),
          emitters_(world.emitters.size()),
          hash_(world_hash(world)),
          device_(current_device()),
          memory_(memory),
          anchors_(world.anchors),
          world_(world, anchors_),
          order_{world_.job().grid, {}},
          reorders_(options.reorder_every_steps > 0 && world.wind.kind == WindKind::grid),
          selection_(capacity_),
          rearrange_(capacity_, reorders_ ? Rearranger::Reorders::yes : Rearranger::Reorders::no,
                     order_.key_bits()),
          sort_(capacity_)
    {
    }
    ~CudaBackend() override { cudaStreamSynchronize(stream_.ref().get()); }

    std::string name() const override
    {
        return fmt::format(
            "cuda ({}, compute {}.{}, step graph {}{})", device_.name, device_.compute_major,
            device_.compute_minor, options_.graph == StepGraph::on ? "on" : "off",
            reorders_ ? fmt::format(", re-ordered every {} steps", options_.reorder_every_steps) : "");
    }

    void open() override { addresses(); }
    void close(const DrawList& list) override;
    void finish() override { stream_.ref().wait(); }
    void step() override;
    DrawList prepare(const View& view, const SortSettings& sort) override;

    FlakeCounts counts() const override { return late_.newest().state.counts; }
    std::uint64_t step_number() const override { return step_; }
    std::uint64_t slots_used() const override { return late_.newest().state.used; }
    std::uint64_t state_hash() const override;
    FlakeExtent extent() const override;
    Snapshot save() const override;
    void restore(const Snapshot& snapshot) override;
    StageTimes times() const override;
    void set_anchor(int index, Vec3f position_m) override
    {
        anchors_.set(index, position_m);
        world_.place_anchors(stream_, anchors_);
    }

  private:
    /// Behind what a step leaves: nothing, holes closed if there are many, or flakes in the order of cells.
    enum class Behind
    {
        tidy_up,
        reorder,
    };

    /// Looks at the flakes between frames: memory that was not open is closed again, since GL may read it
    /// next.
    class Look
    {
      public:
        explicit Look(const CudaBackend& backend) : backend_(backend), was_open_(backend.mapped_) {}
        ~Look()
        {
            if (!was_open_) backend_.mapped_.reset();
        }
        Look(const Look&) = delete;
        Look& operator=(const Look&) = delete;

      private:
        const CudaBackend& backend_;
        bool was_open_;
    };

    const FlakeAddresses& addresses() const;
    const StepControl* control() const { return world_.step().control; }
    void queue_step(Behind behind);
    void mark(std::size_t stage)
    {
        if (options_.graph == StepGraph::off) step_clock_.mark(stream_, stage);
    }
    const CapturedGraph& graph(Behind behind);
    StepState exact_state() const;

    struct Recording
    {
        FlakeAddresses at;
        const std::uint32_t* ranks;
        CapturedGraph work;
    };

    CudaOptions options_;
    std::uint64_t capacity_;
    std::size_t emitters_;
    std::uint64_t hash_;
    DeviceInfo device_;
    FlakeMemory& memory_;
    Stream stream_;
    Anchors anchors_;
    DeviceWorld world_;
    CellOrder order_;  ///< but for the flakes
    bool reorders_;
    SelectionMemory selection_;
    Rearranger rearrange_;
    DrawSort sort_;
    mutable FlakeSums sums_;
    mutable LateControl late_;
    mutable StageClock<3> step_clock_;   ///< emit, advect, compact; with a graph they are not told apart
    mutable StageClock<1> graph_clock_;  ///< the step as a whole
    mutable StageClock<1> cull_clock_, sort_clock_;
    std::optional<Recording> recordings_[2];  ///< by Behind
    mutable std::optional<MappedFlakes> mapped_;
    std::uint64_t step_ = 0;
};

const FlakeAddresses& CudaBackend::addresses() const
{
    if (!mapped_) mapped_.emplace(memory_, stream_);
    return mapped_->addresses();
}

void CudaBackend::close(const DrawList& list)
{
    if (!mapped_) return;
    memory_.hand_over(stream_, late_.newest().state.used, list);
    mapped_->close();
    mapped_.reset();
}

void CudaBackend::queue_step(Behind behind)
{
    const FlakeAddresses& at = addresses();
    AdvectJob job = world_.job();
    job.flakes = at.flakes;
    begin_step(stream_, world_.step());
    blow(stream_, world_.step());
    rearrange_.close_holes(stream_, control(), at, selection_.get(), sort_.ranks());
    emit(stream_, world_.step(), job);
    mark(0);
    // the draw list is made anew before it is drawn
    advect(stream_, world_.step(), job, reinterpret_cast<std::uint32_t*>(at.draw_list.pairs));
    mark(1);
    end_step(stream_, world_.step(), behind == Behind::reorder ? Closing::always : Closing::if_many);
    if (behind == Behind::reorder)
        rearrange_.reorder(stream_, control(), at, {order_.grid, at.flakes}, sort_.ranks());
    else
        rearrange_.close_holes(stream_, control(), at, selection_.get(), sort_.ranks());
    mark(2);
}

/// Recorded anew when the memory has come to lie elsewhere, or ranks are to go with the flakes.
const CapturedGraph& CudaBackend::graph(Behind behind)
{
    std::optional<Recording>& recording = recordings_[static_cast<std::size_t>(behind)];
    if (!recording || !(recording->at == addresses()) || recording->ranks != sort_.ranks())
        recording.emplace(
            Recording{addresses(), sort_.ranks(), CapturedGraph(stream_, [&] { queue_step(behind); })});
    return recording->work;
}

void CudaBackend::step()
{
    addresses();
    const Behind behind =
        reorders_ && (step_ + 1) % options_.reorder_every_steps == 0 ? Behind::reorder : Behind::tidy_up;
    if (options_.graph == StepGraph::on)
    {
        const CapturedGraph& work = graph(behind);
        graph_clock_.begin(stream_);
        work.launch(stream_);
        graph_clock_.mark(stream_, 0);
    }
    else
    {
        step_clock_.begin(stream_);
        queue_step(behind);
    }
    ++step_;
    late_.ask(stream_, control());
}

DrawList CudaBackend::prepare(const View& view, const SortSettings& settings)
{
    const SortStrategy& strategy = DrawSort::strategy(settings);
    const FlakeAddresses& at = addresses();
    cull_clock_.begin(stream_);
    list_visible(stream_, world_.step().control, capacity_, at,
                 frustum(view, DrawSort::key_bits(settings, strategy)), selection_.get());
    cull_clock_.mark(stream_, 0);
    // the one wait of a frame: a sort must be told how many pairs there are (docs/decisions/012)
    late_.ask(stream_, control());
    const StepControl& now = late_.wait();
    DrawList list;
    list.count = now.visible;
    list.culled = now.state.counts.alive - now.visible;
    list.slots = now.state.used;
    sort_clock_.begin(stream_);
    sort_(stream_, strategy, settings, view, at.draw_list, list);
    if (reorders_ && list.sorted && !strategy.network)
        order_ties(stream_, list.in_scratch ? at.draw_list.scratch : at.draw_list.pairs, list.count,
                   at.flakes.id, static_cast<std::uint32_t>(now.state.next_id));
    sort_clock_.mark(stream_, 0);
    return list;
}

/// Waits.
StepState CudaBackend::exact_state() const
{
    stream_.ref().wait();
    return late_.newest().state;
}

std::uint64_t CudaBackend::state_hash() const
{
    const Look look(*this);
    const std::uint64_t sum = sums_.hash(stream_, control(), capacity_, addresses().flakes);
    return sum + counts_hash(exact_state().counts);
}

FlakeExtent CudaBackend::extent() const
{
    const Look look(*this);
    return sums_.extent(stream_, control(), capacity_, addresses().flakes);
}

Snapshot CudaBackend::save() const
{
    const Look look(*this);
    const StepState state = exact_state();
    std::vector<std::uint32_t> words[kFlakeArrays];
    const auto arrays = flake_words(addresses().flakes);
    for (std::size_t a = 0; a < kFlakeArrays; ++a)
    {
        words[a].resize(state.used);
        if (state.used > 0) copy_to_host(stream_, words[a].data(), arrays[a], state.used);
    }
    Snapshot s;
    s.world_hash = hash_;
    s.step = state.step;
    s.next_id = state.next_id;
    s.counts = state.counts;
    world_.save_emission(stream_, s.emitter_state);
    anchors_.save(s.emitter_state);
    stream_.ref().wait();
    for (const auto& array : words)
    {
        std::vector<std::uint32_t>& alive = s.arrays.emplace_back();
        for (std::size_t i = 0; i < array.size(); ++i)
            if (is_alive(words[kFlakeArrays - 1][i])) alive.push_back(array[i]);
    }
    return s;
}

void CudaBackend::restore(const Snapshot& s)
{
    check_snapshot(s, hash_, capacity_, emitters_, anchors_);
    const Look look(*this);
    const auto arrays = flake_words(addresses().flakes);
    for (std::size_t a = 0; a < kFlakeArrays; ++a)
        if (!s.arrays[a].empty()) copy_to_device(stream_, arrays[a], s.arrays[a].data(), s.arrays[a].size());
    world_.restore_emission(stream_, s.emitter_state.data());
    anchors_.restore(s.emitter_state.data() + 2 * emitters_);
    world_.place_anchors(stream_, anchors_);
    StepControl control;
    control.state = {s.counts, s.step, s.next_id, s.counts.alive};
    control.used = static_cast<std::uint32_t>(s.counts.alive);
    world_.restore_control(stream_, control);
    late_.set(control);
    sort_.forget_order();
    step_ = s.step;
}

StageTimes CudaBackend::times() const
{
    StageTimes t;
    const auto& stages = step_clock_.read();
    t.emit = stages[0], t.advect = stages[1], t.compact = stages[2];
    t.step = options_.graph == StepGraph::on ? graph_clock_.read()[0] : stages[0] + stages[1] + stages[2];
    t.cull = cull_clock_.read()[0];
    t.sort = sort_clock_.read()[0];
    return t;
}

}  // namespace

std::unique_ptr<Backend> make_cuda_backend(const World& world, FlakeMemory& memory,
                                           const CudaOptions& options)
{
    check_world(world);
    if (memory.capacity() != world.capacity)
        throw Error(fmt::format("the flakes' memory holds {}, the world {}; make it for the world's capacity",
                                memory.capacity(), world.capacity));
    return std::make_unique<CudaBackend>(world, memory, options);
}

}  // namespace spindrift::gpu
