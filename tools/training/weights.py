"""Reads the weights of a network back from the file that export.py wrote. Needs Debian's python3-opencv."""
from pathlib import Path

import torch
from torch import Tensor, nn

from network import HandNetwork

# The weight and the bias of each convolution and linear layer, in order. The convolutions include the normalisation that
# follows them in training.
FoldedWeights = list[tuple[Tensor, Tensor]]


def read_folded(network: HandNetwork, path: Path) -> FoldedWeights:
    """The weights of the file, which must hold a network of the same shape as `network`. Its last layers may be missing:
    version 1 of the interface had none that tells a hand."""
    import cv2

    if not path.is_file():
        raise SystemExit(f"{path} is missing (give a folder that train.py or configs/nets filled)")
    reader = cv2.dnn.readNetFromONNX(str(path))
    layers = [reader.getLayer(reader.getLayerId(name)).blobs for name in reader.getLayerNames()]
    stored = [tuple(torch.from_numpy(blob.copy()) for blob in blobs) for blobs in layers if len(blobs)]
    wanted = [module.weight.shape for module, _ in _with_normalisations(network)]
    if [blobs[0].shape for blobs in stored] not in (wanted, wanted[:-2]):
        raise SystemExit(f"{path} holds another network (give a folder that train.py or configs/nets filled)")
    return stored


def set_folded(network: HandNetwork, folded: FoldedWeights) -> None:
    """Sets the weights of `network`, with normalisations that change nothing but add what the convolutions add."""
    for (module, normalisation), (weight, bias) in zip(_with_normalisations(network), folded):
        module.weight.data.copy_(weight)
        if normalisation is None:
            module.bias.data.copy_(bias.flatten())
            continue
        normalisation.running_mean.zero_()
        normalisation.running_var.fill_(1 - normalisation.eps)
        normalisation.weight.data.fill_(1)
        normalisation.bias.data.copy_(bias.flatten())


def read_weights(network: HandNetwork, path: Path, images: Tensor) -> None:
    """Sets the weights of `network` to those of the file, for further training: each normalisation is separated again from
    its convolution, by the mean and the variance on typical `images` [B, 2, H, W]."""
    set_folded(network, read_folded(network, path))

    # Measure what reaches each normalisation, then let it normalise that and undo it.
    normalisations = [normalisation for _, normalisation in _with_normalisations(network) if normalisation]
    inputs: dict[nn.Module, Tensor] = {}
    hooks = [one.register_forward_pre_hook(lambda module, given: inputs.update({module: given[0]})) for one in normalisations]
    with torch.no_grad():
        network.eval()(images)
        for one, hook in zip(normalisations, hooks):
            hook.remove()
            mean, variance = inputs[one].mean((0, 2, 3)), inputs[one].var((0, 2, 3)).clamp_min(1e-4)
            one.bias.data += mean
            one.weight.data.copy_((variance + one.eps).sqrt())
            one.running_mean.copy_(mean)
            one.running_var.copy_(variance)


def _with_normalisations(network: HandNetwork) -> list[tuple[nn.Module, nn.BatchNorm2d | None]]:
    """Each convolution and linear layer with the normalisation that follows it."""
    modules = [module for module in network.modules() if isinstance(module, (nn.Conv2d, nn.Linear, nn.BatchNorm2d))]
    return [(module, follower if isinstance(follower, nn.BatchNorm2d) else None)
            for module, follower in zip(modules, modules[1:] + [None]) if not isinstance(module, nn.BatchNorm2d)]
