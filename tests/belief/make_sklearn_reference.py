"""Writes sklearn_reference.txt: posteriors of 20 random scenes by scikit-learn (run by Debian's /usr/bin/python3, python3-sklearn 1.2.1).

Each scene is a line `scene family length signal noise_variance n m`, then n lines `u v reading`, then m lines `u v mean variance`, metres and reading
units. A scene's field has zero mean. Lengths and noises keep the condition number below 1e7, so that both sides are good to 1e-8.
"""
import numpy as np
from sklearn.gaussian_process import GaussianProcessRegressor
from sklearn.gaussian_process.kernels import RBF, ConstantKernel, Matern

random = np.random.RandomState(20160821)
families = ["squared-exponential", "matern-1/2", "matern-3/2", "matern-5/2"]
lines = []
for scene in range(20):
    family = families[scene % 4]
    length = float(random.uniform(1.5, 6.0))  # in mm here, so that scikit-learn's own scale is ordinary
    signal = float(np.exp(random.uniform(-2, 3)))
    noise = signal**2 * 10 ** float(random.uniform(-4, -1))
    n, m = int(random.randint(1, 60)), 12
    places = random.uniform([0, 0], [25, 50], size=(n, 2))
    readings = signal * (np.sin(places[:, 0] / 4) + np.cos(places[:, 1] / 7)) + np.sqrt(noise) * random.normal(size=n)
    queries = random.uniform([0, 0], [25, 50], size=(m, 2))
    queries[0] = places[0]
    base = RBF(length) if scene % 4 == 0 else Matern(length, nu=[None, 0.5, 1.5, 2.5][scene % 4])
    model = GaussianProcessRegressor(ConstantKernel(signal**2) * base, alpha=noise, optimizer=None).fit(places, readings)
    mean, sd = model.predict(queries, return_std=True)
    lines.append(f"scene {family} {length / 1e3!r} {signal!r} {noise!r} {n} {m}")
    lines += [f"{u / 1e3!r} {v / 1e3!r} {float(y)!r}" for (u, v), y in zip(places.tolist(), readings)]
    lines += [f"{u / 1e3!r} {v / 1e3!r} {float(f)!r} {float(s) ** 2!r}" for (u, v), f, s in zip(queries.tolist(), mean, sd)]
with open(__file__.replace("make_sklearn_reference.py", "sklearn_reference.txt"), "w") as file:
    file.write("\n".join(lines) + "\n")
