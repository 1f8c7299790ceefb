"""Scripts in Exudyn's own items, each with its result beside the exact answer: to open, change and run by whoever
learns Exudyn or this contact (docs/exudyn.md, docs/exudyn_recipe.md). Tests run them, and nothing else uses them."""
