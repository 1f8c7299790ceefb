"""What a history says: λ₀, r₀, λ₁, r₁, impulse, hits and peaks, each with its error bar. Nothing here knows a path or
the theory."""
