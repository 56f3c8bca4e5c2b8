// The boundary: nothing that is thrown below gets past it.
#pragma once

#include "modules/brittle/abi/context.h"

#include <exception>
#include <new>

namespace brittle::abi {

// What went wrong, told by `fail`, a function of code and message that does not throw.
template <class Call, class Fail>
BrittleResult caught(Call&& call, Fail&& fail) noexcept {
    try {
        call();
        return BRITTLE_OK;
    } catch (const Refusal& refusal) {
        return fail(refusal.code, refusal.message.c_str());
    } catch (const std::bad_alloc&) {
        return fail(BRITTLE_OUT_OF_MEMORY, "the host is out of memory");
    } catch (const std::exception& thrown) {
        return fail(BRITTLE_INTERNAL, thrown.what());
    } catch (...) {
        return fail(BRITTLE_INTERNAL, "something unknown was thrown");
    }
}

template <class Call>
BrittleResult bounded(BrittleContext* context, Call&& call) noexcept {
    if (context == nullptr) return BRITTLE_NULL_ARGUMENT;
    return caught([&] { call(*context); },
                  [&](BrittleResult code, const char* message) { return context->fail(code, message); });
}

} // namespace brittle::abi
