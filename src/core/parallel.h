#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <vector>

namespace polargrain {

/// Runs the pieces of a loop on several threads.
///
/// Pieces are taken by whichever thread is free, so that a thread that the system does not serve holds up nothing but
/// the piece that it is in. What a piece computes must not depend on the others; where they are to be summed, each
/// keeps its own sum, and these are added in order afterwards: then any number of threads gives the same bits.
class Parallel {
public:
    /// threads: at least 1; 1 runs everything where it is called.
    explicit Parallel(int threads);
    ~Parallel();
    Parallel(Parallel&&) noexcept;
    Parallel& operator=(Parallel&&) noexcept;

    int threads() const { return threads_; }

    /// Calls piece(0) ... piece(count - 1), each once, in any order; returns when all are done. An exception of a piece
    /// is passed on.
    void each(std::size_t count, const std::function<void(std::size_t)>& piece) const;

    /// Cuts [0, count) into runs of `length`, the last one shorter, and calls run(first, last) for each.
    template <typename Run>
    void runs(std::size_t count, std::size_t length, const Run& run) const {
        each((count + length - 1) / length, [&](std::size_t k) {
            const std::size_t first = k * length;
            run(first, first + length < count ? first + length : count);
        });
    }

    /// The sum of what run(first, last) returns for each of these runs, added in order.
    template <typename Run>
    auto sum(std::size_t count, std::size_t length, const Run& run) const {
        std::vector<decltype(run(count, count))> parts((count + length - 1) / length);
        runs(count, length, [&](std::size_t first, std::size_t last) { parts[first / length] = run(first, last); });
        decltype(run(count, count)) total{};
        for (const auto& part : parts) total += part;
        return total;
    }

    /// Does test(k) hold for any k in [0, count)? All are asked, in runs of `length`.
    template <typename Test>
    bool any(std::size_t count, std::size_t length, const Test& test) const {
        std::vector<char> holds((count + length - 1) / length);
        runs(count, length, [&](std::size_t first, std::size_t last) {
            bool of_run = false;
            for (std::size_t k = first; k < last && !of_run; ++k) of_run = test(k);
            holds[first / length] = of_run;
        });
        for (const char of_run : holds) {
            if (of_run) return true;
        }
        return false;
    }

private:
    struct Team;
    static std::shared_ptr<Team> team_of(int threads);

    int threads_;
    std::shared_ptr<Team> team_;  ///< none for one thread
};

}  // namespace polargrain
