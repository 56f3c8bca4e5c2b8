kernel(tick.comp)
