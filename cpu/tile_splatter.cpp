// SPDX-License-Identifier: MIT
#include "cpu/tile_splatter.h"

#include <span>
#include <utility>
#include <vector>

#include "cpu/arena.h"
#include "cpu/chunks.h"
#include "cpu/parallel.h"
#include "cpu/simd.h"

namespace spindrift::cpu
{

namespace
{

/// The sprites of each tile in the order of the draw list: a counting sort by tile whose pieces are the
/// chunks of the list.
class TileBins
{
  public:
    void resize(const SplatPicture& picture, std::size_t sprites)
    {
        across_ = static_cast<std::size_t>((picture.width_px + kTilePx - 1) / kTilePx);
        down_ = static_cast<std::size_t>((picture.height_px + kTilePx - 1) / kTilePx);
        chunks_ = chunk_count(sprites);
        starts_.assign(tiles() * chunks_ + 1, 0);
        if (boxes_.size() < sprites) boxes_.resize(sprites);
    }

    TileBox* boxes() { return boxes_.data(); }
    std::size_t tiles() const { return across_ * down_; }
    int x_px(std::size_t tile) const { return static_cast<int>(tile % across_) * kTilePx; }
    int y_px(std::size_t tile) const { return static_cast<int>(tile / across_) * kTilePx; }

    void count(std::size_t chunk, std::size_t sprites)
    {
        each(chunk, sprites, [&](std::uint32_t, std::size_t tile) { ++starts_[tile * chunks_ + chunk]; });
    }
    void sum_up()
    {
        std::uint32_t sum = 0;
        for (std::uint32_t& start : starts_) sum += std::exchange(start, sum);
        if (which_.size() < sum) which_.resize(sum);
    }
    /// Afterwards each start is the end of its piece: where the next one begins.
    void fill(std::size_t chunk, std::size_t sprites)
    {
        each(chunk, sprites,
             [&](std::uint32_t sprite, std::size_t tile)
             { which_[starts_[tile * chunks_ + chunk]++] = sprite; });
    }
    std::span<const std::uint32_t> of(std::size_t tile) const
    {
        if (chunks_ == 0) return {};
        const std::size_t first = tile == 0 ? 0 : starts_[tile * chunks_ - 1];
        return {which_.data() + first, starts_[(tile + 1) * chunks_ - 1] - first};
    }

  private:
    template <class Body>
    void each(std::size_t chunk, std::size_t sprites, const Body& body) const
    {
        const Chunk range(chunk, sprites);
        for (std::size_t i = range.first; i < range.last; ++i)
        {
            const TileBox box = boxes_[i];
            if (box.first_x > box.last_x) continue;
            for (int y = box.first_y; y <= box.last_y; ++y)
                for (int x = box.first_x; x <= box.last_x; ++x)
                    body(static_cast<std::uint32_t>(i),
                         static_cast<std::size_t>(y) * across_ + static_cast<std::size_t>(x));
        }
    }

    std::size_t across_ = 0, down_ = 0, chunks_ = 0;
    std::vector<TileBox> boxes_;
    std::vector<std::uint32_t> starts_;  ///< by tile, then chunk
    std::vector<std::uint32_t> which_;
};

class TileSplatter final : public Splatter
{
  public:
    explicit TileSplatter(const CpuOptions& options)
        : kernels_(kernels(choose_simd(options.simd))), arena_(options.threads)
    {
    }

    void splat(const SplatJob& job, const SplatPicture& picture) override
    {
        arena_.execute([&] { splat_in_arena(job, picture); });
    }

  private:
    void splat_in_arena(const SplatJob& job, const SplatPicture& picture)
    {
        bins_.resize(picture, job.count);
        if (sprites_.size() < job.count) sprites_.resize(job.count);
        if (job.air.thick && ambients_.size() < job.count) ambients_.resize(job.count);
        if (job.shutter_s > 0 && streaks_.size() < job.count) streaks_.resize(job.count);
        const std::size_t chunks = chunk_count(job.count);
        parallel_for_each_index(chunks,
                                [&](std::size_t c)
                                {
                                    const Chunk chunk(c, job.count);
                                    kernels_.place_sprites(job, chunk.first, chunk.last, sprites_.data(),
                                                           bins_.boxes(), ambients_.data(), streaks_.data());
                                    bins_.count(c, job.count);
                                });
        bins_.sum_up();
        parallel_for_each_index(chunks, [&](std::size_t c) { bins_.fill(c, job.count); });
        parallel_for_each_index(bins_.tiles(),
                                [&](std::size_t tile)
                                {
                                    const std::span<const std::uint32_t> which = bins_.of(tile);
                                    kernels_.blend_tile(job, picture, bins_.x_px(tile), bins_.y_px(tile),
                                                        sprites_.data(), ambients_.data(), streaks_.data(),
                                                        which.data(), which.size());
                                });
    }

    const KernelTable& kernels_;
    Arena arena_;
    TileBins bins_;
    std::vector<PlacedSprite> sprites_;
    std::vector<Vec3f> ambients_;        ///< filled in thick air only
    std::vector<PlacedStreak> streaks_;  ///< filled with a shutter time only
};

}  // namespace

std::unique_ptr<Splatter> make_tile_splatter(const CpuOptions& options)
{
    return std::make_unique<TileSplatter>(options);
}

}  // namespace spindrift::cpu
