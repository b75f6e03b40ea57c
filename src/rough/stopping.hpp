// Whatever takes long asks now and then whether it shall go on.
#pragma once

#include <atomic>
#include <functional>

namespace rsc {

// While it lives, stopping_point() on this thread calls `ask`, at most every 50 ms. To stop the work `ask` throws.
class Watch {
public:
    explicit Watch(std::function<void()> ask);
    Watch(const Watch&) = delete;
    Watch& operator=(const Watch&) = delete;
    ~Watch();

    static Watch* here();  // that of this thread, or null
    // While it lives, stopping_point() on this thread throws once the thread of the watch has been stopped.
    class Shared {
    public:
        explicit Shared(Watch* watch);
        Shared(const Shared&) = delete;
        Shared& operator=(const Shared&) = delete;
        ~Shared();

    private:
        Watch* before_;
    };

private:
    std::function<void()> ask_;
    Watch* before_;
    std::atomic<bool> stopped_{false};
    friend void stopping_point();
};

// A place where work may be left by an exception: outside of parallel regions, and where nothing is half done.
void stopping_point();

}  // namespace rsc
