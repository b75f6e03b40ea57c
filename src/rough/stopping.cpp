#include "rough/stopping.hpp"

#include <chrono>
#include <stdexcept>
#include <utility>

namespace rsc {
namespace {

thread_local Watch* watch = nullptr;
thread_local Watch* of_another = nullptr;  // thread
thread_local std::chrono::steady_clock::time_point asked;

}  // namespace

Watch::Watch(std::function<void()> ask) : ask_(std::move(ask)), before_(std::exchange(watch, this)) {}
Watch::~Watch() { watch = before_; }

Watch* Watch::here() { return watch; }
Watch::Shared::Shared(Watch* shared) : before_(std::exchange(of_another, watch ? nullptr : shared)) {}
Watch::Shared::~Shared() { of_another = before_; }

void stopping_point() {
    if (of_another && of_another->stopped_) throw std::runtime_error("stopped");
    if (!watch) return;
    const auto now = std::chrono::steady_clock::now();
    if (now - asked < std::chrono::milliseconds(50)) return;
    asked = now;
    try {
        watch->ask_();
    } catch (...) {
        watch->stopped_ = true;
        throw;
    }
}

}  // namespace rsc
