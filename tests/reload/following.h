// A reloader at work on a folder of sources, and what it says.
#pragma once

#include "engine/reload/shader_reloader.h"
#include "tests/reload/source_folder.h"

#include <algorithm>
#include <chrono>
#include <functional>
#include <thread>
#include <vector>

namespace reload_test {

using Kind = engine::ReloadEvent::Kind;

// The patience of a test on a busy machine under validation layers and sanitizers: nothing is measured by it.
constexpr std::chrono::seconds kPatience{40};

class Following {
public:
    explicit Following(std::unique_ptr<engine::ShaderReloader> reloader) : reloader_(std::move(reloader)) {}
    engine::ShaderReloader* operator->() { return reloader_.get(); }

    // Between frames: takes over what is ready.
    void swap() {
        for (engine::ReloadEvent& event : reloader_->swap())
            events_.push_back(std::move(event));
    }
    // The next event of a kind that names this kernel, or any; those before it are left out. Fails the test where none comes.
    engine::ReloadEvent next(Kind kind, const std::string& kernel = "") {
        const auto begun = std::chrono::steady_clock::now();
        for (;;) {
            swap();
            while (!events_.empty()) {
                engine::ReloadEvent event = std::move(events_.front());
                events_.erase(events_.begin());
                const bool is_named = kernel.empty() || std::ranges::find(event.kernels, kernel) != event.kernels.end();
                if (event.kind == kind && is_named) return event;
            }
            if (std::chrono::steady_clock::now() - begun > kPatience) {
                ADD_FAILURE() << "nothing was said of " << kernel;
                return {};
            }
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
        }
    }
    // Until all that it has heard of is done; what was said meanwhile, and not asked for.
    std::vector<engine::ReloadEvent> settle() {
        std::vector<engine::ReloadEvent> said;
        for (int calm = 0; calm < 30; calm = reloader_->isIdle() ? calm + 1 : 0) {
            swap();
            std::ranges::move(events_, std::back_inserter(said));
            events_.clear();
            std::this_thread::sleep_for(std::chrono::milliseconds(5));
        }
        return said;
    }

private:
    std::unique_ptr<engine::ShaderReloader> reloader_;
    std::vector<engine::ReloadEvent> events_;
};

} // namespace reload_test
