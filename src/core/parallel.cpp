#include "src/core/parallel.h"

#include <oneapi/tbb/info.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>

#include <algorithm>
#include <map>
#include <mutex>

namespace polargrain {

struct Parallel::Team {
    // More than there are processors would only wait for one another.
    explicit Team(int threads) : arena(std::min(threads, tbb::info::default_concurrency())) {}
    tbb::task_arena arena;
};

/// One for all that want as many threads: threads that change between teams would fall asleep and be woken each time.
std::shared_ptr<Parallel::Team> Parallel::team_of(int threads) {
    static std::mutex access;
    static std::map<int, std::weak_ptr<Team>> teams;
    const std::lock_guard lock(access);
    std::shared_ptr<Team> team = teams[threads].lock();
    if (!team) {
        team = std::make_shared<Team>(threads);
        teams[threads] = team;
    }
    return team;
}

Parallel::Parallel(int threads) : threads_(threads) {
    if (threads > 1) team_ = team_of(threads);
}

Parallel::~Parallel() = default;
Parallel::Parallel(Parallel&&) noexcept = default;
Parallel& Parallel::operator=(Parallel&&) noexcept = default;

void Parallel::each(std::size_t count, const std::function<void(std::size_t)>& piece) const {
    if (!team_ || count < 2) {
        for (std::size_t k = 0; k < count; ++k) piece(k);
        return;
    }
    team_->arena.execute([&] {
        tbb::parallel_for(
            std::size_t{0}, count, [&](std::size_t k) { piece(k); }, tbb::simple_partitioner());
    });
}

}  // namespace polargrain
