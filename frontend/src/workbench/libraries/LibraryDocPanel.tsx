import { useChosenItem } from './chosen';
import { ItemDoc } from './ItemDoc';

/** Documentation of the item chosen in the Libraries view. */
export default function LibraryDocPanel() {
  const { library, item } = useChosenItem();
  return <ItemDoc library={library} item={item} />;
}
