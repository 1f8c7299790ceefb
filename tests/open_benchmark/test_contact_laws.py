"""What docs/benchmark.md says of contact laws on velocities."""

from open_benchmark.contact_laws import LAWS, PROBLEMS, compared_laws, laws_text


def test_a_law_on_gaps_keeps_the_first_order_that_a_law_on_velocities_loses():
    size = 0.02
    found = compared_laws(sizes=(size,))
    velocities, positions = (found[name, size] for name in LAWS)
    # without loads both are as good
    assert max(abs(e or 1.0) for errors in (velocities, positions) for e in errors[PROBLEMS[0]]) < 4e-3
    # with loads the roughness of the law on velocities is of the order of the answer
    rough, smooth = (max(abs(e or 1.0) for name in PROBLEMS[1:] for e in law[name]) for law in (velocities, positions))
    assert smooth < 0.08 < 0.2 < rough
    assert laws_text(found).count("\n") == 3
