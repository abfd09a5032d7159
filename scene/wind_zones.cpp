// SPDX-License-Identifier: MIT
#include "scene/wind_zones.h"

#include <algorithm>
#include <cmath>

namespace spindrift::scene
{

namespace
{

/// A cell near a block: where it is along and across the wind of that block.
struct Place
{
    std::size_t cell;
    double s, t, z;
    double across;  ///< of the half width
    double height;  ///< above the ground at the block's foot
    WindBlock::Strip strip;
};

class ZoneFill
{
  public:
    ZoneFill(StaggeredWind& wind, Vec3d low_m, const InflowProfile& profile, const GroundHeight& ground_m)
        : wind_(wind), n_(wind.size), low_m_(low_m), profile_(profile)
    {
        double low = low_m.z;
        for (const double layer : wind.layer_m)
        {
            centre_z_.push_back(low + 0.5 * layer);
            low += layer;
        }
        for (int y = 0; y < n_.ny; ++y)
            for (int x = 0; x < n_.nx; ++x) ground_.push_back(ground_m(centre_x(x), centre_y(y)));
        mean_.resize(n_.count());
        zone_.assign(n_.count(), WindZone::fluid);
    }

    void approach()
    {
        std::size_t i = 0;
        for (int z = 0; z < n_.nz; ++z)
            for (std::size_t column = 0; column < ground_.size(); ++column, ++i)
            {
                if (wind_.solid[i] != 0)
                    zone_[i] = centre_z_[z] < ground_[column] ? WindZone::terrain : WindZone::building;
                else
                    mean_[i] = approaching(column, centre_z_[z]);
            }
    }

    void add_blocks(const std::vector<Footprint>& footprints)
    {
        const double strip_m = 0.5 * std::min(wind_.cell_m.x, wind_.cell_m.y);
        for (const Footprint& footprint : footprints)
        {
            const double height = footprint.top_m - footprint.ground_m;
            const Vec3d at_roof = profile_.at(height);
            const double speed = std::hypot(at_roof.x, at_roof.y);
            if (!(height > 0) || !(speed > 0)) continue;
            const WindBlock block(footprint, at_roof * (1 / speed), strip_m);
            if (block.size().width > 0 && block.size().length > 0) blocks_.push_back({block, speed});
        }
        std::stable_sort(blocks_.begin(), blocks_.end(),
                         [](const Met& a, const Met& b) { return a.block.top_m() < b.block.top_m(); });
        // the nearer a wall, the later: what a zone finds it replaces
        for (const Met& met : blocks_) upwind(met);
        for (const Met& met : blocks_) wake(met);
        for (const Met& met : blocks_) cavity(met);
        for (const Met& met : blocks_) canyons(met);
        for (const Met& met : blocks_) separation(met);
    }

    std::vector<WindZone> to_faces()
    {
        const auto mean = [&](int x, int y, int z, int dx, int dy, int dz, auto part)
        {
            const bool low = x - dx >= 0 && y - dy >= 0 && z - dz >= 0,
                       high = x < n_.nx && y < n_.ny && z < n_.nz;
            const double a = low ? static_cast<double>(part(mean_[n_.index(x - dx, y - dy, z - dz)])) : 0;
            const double b = high ? static_cast<double>(part(mean_[n_.index(x, y, z)])) : 0;
            return low && high ? 0.5 * (a + b) : a + b;
        };
        const GridSize u = wind_.u_size(), v = wind_.v_size(), w = wind_.w_size();
        for (int z = 0; z < n_.nz; ++z)
            for (int y = 0; y < n_.ny; ++y)
                for (int x = 0; x <= n_.nx; ++x)
                    wind_.u[u.index(x, y, z)] = mean(x, y, z, 1, 0, 0, [](const Vec3f& m) { return m.x; });
        for (int z = 0; z < n_.nz; ++z)
            for (int y = 0; y <= n_.ny; ++y)
                for (int x = 0; x < n_.nx; ++x)
                    wind_.v[v.index(x, y, z)] = mean(x, y, z, 0, 1, 0, [](const Vec3f& m) { return m.y; });
        for (int z = 0; z <= n_.nz; ++z)
            for (int y = 0; y < n_.ny; ++y)
                for (int x = 0; x < n_.nx; ++x)
                    wind_.w[w.index(x, y, z)] = mean(x, y, z, 0, 0, 1, [](const Vec3f& m) { return m.z; });
        return std::move(zone_);
    }

  private:
    struct Met
    {
        WindBlock block;
        double speed_m_s;  ///< of the approaching wind at the roof
    };

    double centre_x(int x) const { return low_m_.x + (x + 0.5) * wind_.cell_m.x; }
    double centre_y(int y) const { return low_m_.y + (y + 0.5) * wind_.cell_m.y; }

    Vec3f approaching(std::size_t column, double z) const
    {
        const Vec3d v = profile_.at(z - ground_[column]);
        return {static_cast<float>(v.x), static_cast<float>(v.y), 0};
    }

    void put(std::size_t i, const Vec3d& to, double along, double up, WindZone zone)
    {
        mean_[i] = {static_cast<float>(to.x * along), static_cast<float>(to.y * along),
                    static_cast<float>(up)};
        zone_[i] = zone;
    }

    void scale(std::size_t i, double share, WindZone zone)
    {
        mean_[i] = mean_[i] * static_cast<float>(share);
        zone_[i] = zone;
    }

    /// Every fluid cell with s in [front - before, lee + behind] and t up to `beside` beyond the block's
    /// sides, from the block's foot to `above` over its roof.
    template <class Visit>
    void each_near(const WindBlock& block, double before, double behind, double beside, double above,
                   Visit visit)
    {
        const double half = 0.5 * block.size().width;
        const double s[2] = {block.front() - before, block.lee() + behind};
        const double t[2] = {block.middle() - half - beside, block.middle() + half + beside};
        double low[2] = {INFINITY, INFINITY}, high[2] = {-INFINITY, -INFINITY};
        for (const double a : s)
            for (const double b : t)
            {
                const double p[2] = {a * block.to().x - b * block.to().y,
                                     a * block.to().y + b * block.to().x};
                for (int k = 0; k < 2; ++k)
                {
                    low[k] = std::min(low[k], p[k]);
                    high[k] = std::max(high[k], p[k]);
                }
            }
        const auto index = [](double at, double from, double cell, int n)
        { return static_cast<int>(std::clamp(std::floor((at - from) / cell), 0.0, n - 1.0)); };
        for (int y = index(low[1], low_m_.y, wind_.cell_m.y, n_.ny);
             y <= index(high[1], low_m_.y, wind_.cell_m.y, n_.ny); ++y)
            for (int x = index(low[0], low_m_.x, wind_.cell_m.x, n_.nx);
                 x <= index(high[0], low_m_.x, wind_.cell_m.x, n_.nx); ++x)
            {
                const Vec3d p{centre_x(x), centre_y(y), 0};
                Place place{0, block.s(p), block.t(p), 0, 0, 0, {}};
                if (place.s < s[0] || place.s > s[1] || place.t < t[0] || place.t > t[1]) continue;
                place.across = (place.t - block.middle()) / half;
                place.strip = block.strip(place.t);
                each_layer(block, above, x, y, place, visit);
            }
    }

    template <class Visit>
    void each_layer(const WindBlock& block, double above, int x, int y, Place& place, Visit visit)
    {
        for (int z = 0; z < n_.nz && centre_z_[z] < block.top_m() + above; ++z)
        {
            place.cell = n_.index(x, y, z);
            place.z = centre_z_[z];
            place.height = place.z - block.ground_m();
            if (place.z < block.base_m() || wind_.solid[place.cell] != 0) continue;
            visit(place);
        }
    }

    void upwind(const Met& met)
    {
        const WindBlock& block = met.block;
        if (!block.square()) return;
        const double length = upwind_length(block.size());
        each_near(block, length, 0, 0, 0,
                  [&](const Place& p)
                  {
                      const double x = p.strip.front - p.s,
                                   up = p.height / (kUpwindHeight * block.size().height);
                      if (!p.strip.any() || !(x > 0) || up >= 1) return;
                      if (x < length * ellipsoid(p.across, up)) scale(p.cell, kUpwindShare, WindZone::upwind);
                  });
    }

    /// Calls visit(place, x, d) for cells behind the block: x from its lee wall, d the cavity's length there.
    template <class Visit>
    void behind(const WindBlock& block, double cavities, Visit visit)
    {
        const double length = cavity_length(block.size());
        each_near(block, 0, cavities * length, 0, 0,
                  [&](const Place& p)
                  {
                      const double x = p.s - p.strip.lee,
                                   d = length * ellipsoid(p.across, p.height / block.size().height);
                      if (p.strip.any() && x > 0 && x < cavities * d) visit(p, x, d);
                  });
    }

    void wake(const Met& met)
    {
        behind(met.block, kWakeLength,
               [&](const Place& p, double x, double d)
               {
                   if (x >= d) scale(p.cell, wake_speed(x, d), WindZone::wake);
               });
    }

    void cavity(const Met& met)
    {
        behind(met.block, 1,
               [&](const Place& p, double x, double d)
               { put(p.cell, met.block.to(), met.speed_m_s * cavity_speed(x, d), 0, WindZone::cavity); });
    }

    /// Between this block's lee and the nearest block behind it, where that is within the cavity's length.
    void canyons(const Met& met)
    {
        const WindBlock& block = met.block;
        const double length = cavity_length(block.size());
        each_near(block, 0, length, 0, 0,
                  [&](const Place& p)
                  {
                      const double x = p.s - p.strip.lee;
                      if (!p.strip.any() || !(x > 0)) return;
                      double gap = length;
                      for (const Met& other : blocks_)
                      {
                          if (p.z >= other.block.top_m() || p.z < other.block.base_m()) continue;
                          const WindBlock::Strip facing = other.block.strip(p.t);
                          const double wall = facing.front - p.strip.lee;
                          if (facing.any() && wall > x && wall < gap && same_way(block, other.block))
                              gap = wall;
                      }
                      if (gap >= length) return;
                      const CanyonSpeed<double> speed = canyon_speed(x, gap);
                      put(p.cell, block.to(), met.speed_m_s * speed.along, met.speed_m_s * speed.up,
                          WindZone::canyon);
                  });
    }

    /// s and t of two blocks can be compared if their winds agree within about 5 degrees.
    static bool same_way(const WindBlock& a, const WindBlock& b)
    {
        return a.to().x * b.to().x + a.to().y * b.to().y > 0.996;
    }

    void separation(const Met& met)
    {
        const WindBlock& block = met.block;
        if (!block.square()) return;
        const double scale_m = separation_scale(block.size()), length = kSeparationLength * scale_m,
                     depth = kSeparationDepth * scale_m, half = 0.5 * block.size().width;
        each_near(block, 0, 0, depth, depth,
                  [&](const Place& p)
                  {
                      const bool over = p.z >= block.top_m() && p.strip.any();
                      const bool beside = p.z < block.top_m() && std::abs(p.across) > 1;
                      if (!over && !beside) return;
                      const double x = p.s - (over ? p.strip.front : block.front());
                      if (!(x > 0) || x > length || p.s > (over ? p.strip.lee : block.lee())) return;
                      const double off = over ? p.z - block.top_m() : (std::abs(p.across) - 1) * half;
                      const double there = depth * separation_depth(x, length);
                      if (off >= there) return;
                      const std::size_t column =
                          p.cell % (static_cast<std::size_t>(n_.nx) * static_cast<std::size_t>(n_.ny));
                      mean_[p.cell] =
                          approaching(column, p.z) * static_cast<float>(separated_speed(off / there));
                      zone_[p.cell] = WindZone::separated;
                  });
    }

    StaggeredWind& wind_;
    GridSize n_;
    Vec3d low_m_;
    const InflowProfile& profile_;
    std::vector<double> centre_z_, ground_;
    std::vector<Vec3f> mean_;
    std::vector<WindZone> zone_;
    std::vector<Met> blocks_;
};

}  // namespace

std::vector<WindZone> fill_zones(StaggeredWind& wind, Vec3d low_m, const InflowProfile& profile,
                                 const GroundHeight& ground_m, const std::vector<Footprint>& footprints)
{
    ZoneFill fill(wind, low_m, profile, ground_m);
    fill.approach();
    fill.add_blocks(footprints);
    return fill.to_faces();
}

}  // namespace spindrift::scene
